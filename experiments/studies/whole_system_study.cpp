// The whole system: seconds against error for one number that a user names, beside other programs where they
// were measured, and the thesis's own office and settings.

#include <fstream>

#include <fmt/format.h>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

// Solves with the options, and adds rows for what the interpolants show and what exact irradiance gives.
StudyRow Measure(StudyLog& log, const ReferenceCase& test, const PipelineOptions& options,
                 const std::string& setting, double parameter, int repeats) {
  Measured measured = MeasurePipeline(test, options, repeats);
  StudyRow& row = measured.row;
  row.method = "penumbra";
  row.setting = setting;
  row.parameter = parameter;
  log.Add(row);

  StudyRow exact;
  exact.scene = test.name;
  exact.method = "penumbra, exact probe";
  exact.setting = setting;
  exact.parameter = parameter;
  SetErrors(ReferenceErrors(test,
                            [&](const ReceiverPoint& at) {
                              return measured.pipeline->irradiance().Anywhere(at).irradiance;
                            }),
            &exact);
  exact.seconds = row.seconds;  // the interpolants have refined its sources
  log.Add(std::move(exact));
  return row;
}

// The rows of experiments/peers/programs.csv.
void AddPeers(StudyLog& log) {
  std::ifstream file("experiments/peers/programs.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::vector<std::string> cell(1);
    bool quoted = false;
    for (const char c : line) {
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cell.emplace_back();
      else
        cell.back() += c;
    }
    if (cell.size() != 8)
      throw InputError("experiments/peers/programs.csv:0: error: not eight columns: " + line);
    StudyRow row;
    row.scene = cell[0];
    row.method = cell[1];
    row.setting = cell[2];
    row.seconds = std::stod(cell[3]);
    row.error_p95 = std::stod(cell[6]);
    row.error_max = std::stod(cell[7]);
    log.Add(std::move(row));
  }
}

void StudyWholeSystem(StudyLog& log) {
  if (!log.quick()) AddPeers(log);
  std::vector<std::string> names = {"floating-cube", "cornell", "office", "building-1x1", "box", "box_grey"};
  if (log.quick()) names.resize(1);
  for (const std::string& name : names) {
    const ReferenceCase test = LoadReferenceCase(name);
    int kept = 0, asked = 0;
    for (const double error :
         log.quick() ? std::vector<double>{0.1} : std::vector<double>{0.1, 0.05, 0.02, 0.01, 0.005}) {
      PipelineOptions options;
      options.error = error;
      const StudyRow row =
          Measure(log, test, options, fmt::format("--error {:g}", error), error, error < 0.01 ? 1 : 3);
      ++asked;
      if (row.error_p99 <= error) ++kept;
    }
    log.Find(fmt::format(
        "{}: the 99th percentile at the reference's {} points was at or below the error asked for "
        "with {} of {} settings.",
        test.name, test.points.size(), kept, asked));
    if (test.name != "office" || log.quick()) continue;
    const StudyRow row = Measure(log, test, ThesisSettings(), "thesis, chapter 7", StudyRow::kNone, 3);
    constexpr double kThesisSeconds = 2.5 * 3600;  // "two and a half hours of CPU time" for the interpolants
    log.Find(fmt::format(
        "The thesis's settings on our office: {} triangles in {:.2g} s, {:.0f} times less than the "
        "thesis's two and a half hours for its 6,576 in 1996.",
        *row.triangles, row.seconds, kThesisSeconds / row.seconds));
  }
}

}  // namespace

extern const Study kWholeSystemStudy;
const Study kWholeSystemStudy = {
    "whole-system",
    "Seconds of processors against the error of what is shown, at the points of path-traced "
    "references; errors beyond two of their "
    "standard errors",
    "One number, the error that a user names, is met for the whole light, "
    "faster than other programs reach it.",
    "seconds",
    "error_p95",
    StudyWholeSystem};

}  // namespace penumbra
