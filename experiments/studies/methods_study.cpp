// Every solver with every kind of form factors that it takes: seconds against the error of the light that
// exact probes find.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/solvers/light_solvers.h"

namespace penumbra {
namespace {

// A method stops at the setting before the one that would take longer than this, as each takes so many times
// the seconds of the one before.
constexpr double kMostSecondsOfMethod = 60, kGrowthOfMethod = 8;

// A line of the plot: what is fixed, and how the setting that varies is put into the options.
struct MethodLine {
  std::string name;
  PipelineOptions options;
  bool by_error = false;  // the setting is --error; else --divisions
};

bool UsesFormFactors(const LightSolverRegistry::Method& solver) {
  return std::find(solver.parameters.begin(), solver.parameters.end(), "form-factors") !=
         solver.parameters.end();
}

std::vector<MethodLine> MethodLines() {
  std::vector<MethodLine> lines;
  for (const LightSolverRegistry::Method& solver : LightSolvers().methods()) {
    const bool by_error = solver.name == "hierarchical" || solver.name == "sampled";
    const std::vector<std::string> form_factors =
        UsesFormFactors(solver) ? LinkFormFactorMethods().Names() : std::vector<std::string>{""};
    for (const std::string& method : form_factors) {
      MethodLine line;
      line.name = method.empty() ? solver.name : fmt::format("{}, {}", solver.name, method);
      line.by_error = by_error;
      line.options.solver = solver.name;
      line.options.refine = RefineBy::kTransport;
      line.options.max_corrections = 0;
      line.options.relative_cutoff = 1e-3;
      if (!method.empty()) line.options.form_factors = method;
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

StudyRow MeasureLight(const ReferenceCase& test, const PipelineOptions& options) {
  StudyRow row;
  row.scene = test.name;
  std::unique_ptr<Pipeline> pipeline;
  row.seconds = MedianProcessorSeconds(1, [&] {
    pipeline = std::make_unique<Pipeline>(test.scene, options);
    pipeline->Solve({});
  });
  row.elements = pipeline->solution().forest.size();
  SetErrors(
      ReferenceErrors(
          test, [&](const ReceiverPoint& at) { return pipeline->irradiance().Anywhere(at).irradiance; }),
      &row);
  return row;
}

// The rows of one method; the last has the smallest elements.
std::vector<StudyRow> RunLine(StudyLog& log, const ReferenceCase& test, const MethodLine& line) {
  const std::vector<double> errors =
      log.quick() ? std::vector<double>{0.2} : std::vector<double>{0.8, 0.4, 0.2, 0.1, 0.05};
  const std::vector<double> divisions =
      log.quick() ? std::vector<double>{1} : std::vector<double>{1, 2, 4, 8, 16};
  std::vector<StudyRow> rows;
  for (const double setting : line.by_error ? errors : divisions) {
    PipelineOptions options = line.options;
    if (line.by_error)
      options.error = setting;
    else
      options.dense.divisions = static_cast<int>(setting);
    StudyRow row = MeasureLight(test, options);
    row.method = line.name;
    row.setting = fmt::format("{} {:g}", line.by_error ? "error" : "divisions", setting);
    row.parameter = setting;
    rows.push_back(row);
    log.Add(std::move(row));
    if (rows.back().seconds * kGrowthOfMethod > kMostSecondsOfMethod) break;
  }
  return rows;
}

void StudyMethods(StudyLog& log) {
  std::vector<std::string> names = {"box_grey", "cornell", "office"};
  if (log.quick()) names.resize(1);
  for (const std::string& name : names) {
    const ReferenceCase test = LoadReferenceCase(name);
    std::vector<StudyRow> best;
    for (const MethodLine& line : MethodLines()) {
      const std::vector<StudyRow> rows = RunLine(log, test, line);
      best.push_back(*std::min_element(rows.begin(), rows.end(), [](const StudyRow& a, const StudyRow& b) {
        return a.error_rms < b.error_rms;
      }));
    }
    std::sort(best.begin(), best.end(),
              [](const StudyRow& a, const StudyRow& b) { return a.error_rms < b.error_rms; });
    std::string sentence = fmt::format("{}: least rms error of each method (and its seconds)", name);
    for (const StudyRow& row : best)
      sentence += fmt::format("{} {} {:.2g} ({:.2g} s)", &row == &best.front() ? ":" : ",", row.method,
                              row.error_rms, row.seconds);
    log.Find(sentence + ".");
  }
}

}  // namespace

extern const Study kMethodsStudy;
const Study kMethodsStudy = {
    "methods",
    "Every solver with every kind of form factors, without corrections: seconds of processors against the "
    "error of exact probes at the points of path-traced references, beyond two of their standard errors",
    "Hierarchical radiosity with exact visibility reaches an error sooner than the methods before it: "
    "full matrix, progressive refinement and Monte Carlo radiosity, by hemicubes, rays or contours.",
    "seconds",
    "error_rms",
    StudyMethods};

}  // namespace penumbra
