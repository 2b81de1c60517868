// experiments/studies/study.h
//
// What a study is: a small program over the stages of the library that tests one claim, and writes rows of
// speed against error in a form that all studies share. A new study is a file with one `extern const Study`,
// and a line in studies.cpp.

#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mesh/interpolants/representation_error.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// One measurement. What does not apply stays as it is, and is left empty in the CSV.
struct StudyRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string scene;         // what it was measured on
  std::string method;        // a line in a plot
  std::string setting;       // what was varied, in words ("error 0.02")
  double parameter = kNone;  // the same as a number, where it is one
  double seconds = kNone;  // the median of the repeats: wall clock, or of processors where the study says so
  // Errors as the study's title says: relative, unless it says otherwise.
  double error_rms = kNone, error_p95 = kNone, error_p99 = kNone, error_max = kNone;
  std::optional<std::size_t> elements, links, triangles, evaluations, bytes;
};

// What a study writes to while it runs.
class StudyLog {
 public:
  explicit StudyLog(bool quick) : quick_(quick) {}

  // Asks for a run of some seconds at most, which shows that the study works and no more.
  bool quick() const { return quick_; }
  void Add(StudyRow row);
  // A sentence on what came out, with its numbers, made from the rows.
  void Find(std::string sentence);

  const std::vector<StudyRow>& rows() const { return rows_; }
  const std::vector<std::string>& findings() const { return findings_; }

 private:
  bool quick_;
  std::vector<StudyRow> rows_;
  std::vector<std::string> findings_;
};

struct Study {
  const char* name;        // as `experiments/run` knows it
  const char* title;       // one line
  const char* hypothesis;  // what is claimed, and by whom
  const char* x;           // columns of the plot: of one line the x axis ...
  const char* y;           // ... and the y axis, both logarithmic
  void (*run)(StudyLog& log);
};

// All studies, in the order of the report.
const std::vector<const Study*>& Studies();

// What a point of a committed reference knows (experiments/reference, experiments/peers).
struct ReferencePoint {
  Vec3 position, normal;      // [m]; unit
  Rgb irradiance, deviation;  // [W/m^2]; the standard error
};

// The rows of a file with the header x,y,z,nx,ny,nz,Er,Eg,Eb,sr,sg,sb,... under the folder experiments/ of
// the checkout, which is the working directory. Throws InputError where it cannot be read.
std::vector<ReferencePoint> ReadReference(const std::string& name);

// Of all threads of this process so far: differences do not depend on what else the machine does [s].
double ProcessorSeconds();

// The median of the wall-clock seconds of `repeats` calls, and the same of the processors' seconds.
double MedianSeconds(int repeats, const std::function<void()>& work);
double MedianProcessorSeconds(int repeats, const std::function<void()>& work);

// The wall-clock seconds of one call, taken over as many calls as last at least `at_least` seconds.
double SecondsPerCall(double at_least, const std::function<void()>& work);

// Fills the error columns from absolute values of errors; none leaves them empty.
void SetErrors(std::vector<double> errors, StudyRow* row);

// The same from errors that were measured at points.
void CopyErrors(const RepresentationError& errors, StudyRow* row);

// The slope of log y over log x by least squares; pairs that are not positive are left out.
double LogSlope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace penumbra
