// experiments/studies/study.h
//
// A study is a small program that calls stages of the library to test one claim. All studies write rows with
// running times and errors in the same form. To add a study, write a file with one `extern const Study`, and
// add a line to studies.cpp.

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

// A StudyRow holds one measurement of a study. Members that do not apply to a measurement keep their default
// values, and are empty in the CSV file.
struct StudyRow {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  std::string scene;         // scene that was measured
  std::string method;        // name of the line in a plot
  std::string setting;       // quantity that was varied, in words ("error 0.02")
  double parameter = kNone;  // varied quantity as a number, if it is one
  // The median time of the repeats: wall-clock time, or processor time if the study says so [s].
  double seconds = kNone;
  // The errors of a StudyRow are relative, unless the study's title says otherwise.
  double error_rms = kNone, error_p95 = kNone, error_p99 = kNone, error_max = kNone;
  std::optional<std::size_t> elements, links, triangles, evaluations, bytes;
};

// A StudyLog receives the results of a study while the study runs.
class StudyLog {
 public:
  explicit StudyLog(bool quick) : quick_(quick) {}

  // If quick() is true, the study should run for a few seconds at most, only to show that it works.
  bool quick() const { return quick_; }
  void Add(StudyRow row);
  // Adds a finding: a sentence on the results of the study, with numbers computed from the rows.
  void Find(std::string sentence);

  const std::vector<StudyRow>& rows() const { return rows_; }
  const std::vector<std::string>& findings() const { return findings_; }

 private:
  bool quick_;
  std::vector<StudyRow> rows_;
  std::vector<std::string> findings_;
};

struct Study {
  const char* name;        // name of the study for `experiments/run`
  const char* title;       // title of the study, one line
  const char* hypothesis;  // claim that the study tests, and who made the claim
  // The columns of the plot: the CSV column for the x axis and the CSV column for the y axis, both
  // logarithmic.
  const char* x;
  const char* y;
  void (*run)(StudyLog& log);
};

// Returns all studies, in the order of the report.
const std::vector<const Study*>& Studies();

// One point of a stored reference solution (experiments/reference, experiments/peers).
struct ReferencePoint {
  Vec3 position, normal;      // position [m], and unit normal
  Rgb irradiance, deviation;  // irradiance and its standard error [W/m^2]
};

// Reads the points of a reference from a CSV file with the header x,y,z,nx,ny,nz,Er,Eg,Eb,sr,sg,sb,... `name`
// is a path relative to the folder experiments/ of the repository, whose root must be the working directory.
// Throws InputError if the reference file cannot be read.
std::vector<ReferencePoint> ReadReference(const std::string& name);

// Returns the processor time of all threads of this process so far [s]. Differences of processor times depend
// little on other work of the machine.
double ProcessorSeconds();

// MedianSeconds() returns the median wall-clock time of `repeats` calls of `work` [s], and
// MedianProcessorSeconds() their median processor time [s].
double MedianSeconds(int repeats, const std::function<void()>& work);
double MedianProcessorSeconds(int repeats, const std::function<void()>& work);

// Returns the mean wall-clock time of one call of `work` [s], measured over so many calls that they last at
// least `at_least` seconds in total.
double SecondsPerCall(double at_least, const std::function<void()>& work);

// Sets the error columns of `row` from absolute values of errors. If `errors` is empty, the error columns of
// `row` remain empty.
void SetErrors(std::vector<double> errors, StudyRow* row);

// Sets the error columns of `row` from the statistics of errors at random points.
void CopyErrors(const RepresentationError& errors, StudyRow* row);

// Returns the slope of log y over log x by least squares. Pairs (x, y) with a value that is not positive are
// left out of the fit.
double LogSlope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace penumbra
