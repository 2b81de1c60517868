// The whole system: seconds against error for one number that a user names, beside other programs where they
// were measured, and the thesis's own office and settings.

#include <array>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "mesh/pipeline.h"
#include "solver/base/check.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/obj_reader.h"

namespace penumbra {
namespace {

// The floor below which an error is no longer relative to the point's own irradiance: of the channel's mean.
constexpr double kDark = 0.01;
// A reference is taken for what it is within this many of its standard errors.
constexpr double kNoise = 2;

struct Shown {
  std::vector<double> interpolated, exact;  // errors beyond the reference's noise, points times channels
};

Shown Compare(const Pipeline& pipeline, const std::vector<ReferencePoint>& points) {
  const Scene& scene = pipeline.scene();
  Rgb mean = Rgb::Zero();
  for (const ReferencePoint& p : points) mean += p.irradiance / static_cast<double>(points.size());
  const double near = 1e-6 * scene.Diagonal();
  Shown shown;
  for (const ReferencePoint& p : points) {
    const ReceiverPoint at{p.position, p.normal, Vec3::Zero(), 0};
    const Rgb exact = pipeline.irradiance().Anywhere(at).irradiance;
    std::optional<Rgb> interpolated;
    for (std::size_t i = 0; i < scene.patches.size() && !interpolated; ++i) {
      const Patch& patch = scene.patches[i];
      if (patch.normal.dot(p.normal) < 0.9998 ||
          std::abs(patch.normal.dot(p.position - patch.vertex[0])) > near)
        continue;
      interpolated = pipeline.Interpolated(static_cast<PatchId>(i), p.position, near);
    }
    const Rgb scale = p.irradiance.max(kDark * mean);
    const auto add = [&](const Rgb& value, std::vector<double>* errors) {
      for (int c = 0; c < 3; ++c)
        errors->push_back(std::max(0.0, std::abs(value[c] - p.irradiance[c]) - kNoise * p.deviation[c]) /
                          scale[c]);
    };
    add(exact, &shown.exact);
    if (interpolated) add(*interpolated, &shown.interpolated);
  }
  return shown;
}

struct Case {
  std::string name;
  Scene scene;
  std::vector<ReferencePoint> points;
};

std::vector<Case> Cases(bool quick) {
  std::vector<Case> cases;
  for (const std::string name : {"floating-cube", "cornell", "office", "building-1x1"}) {
    if (quick && !cases.empty()) break;
    cases.push_back({name, *LoadBuiltinScene(name, {}), ReadReference("reference/" + name + ".csv")});
  }
  if (quick) return cases;
  for (const std::string name : {"box", "box_grey"})
    cases.push_back({name, ReadObj("experiments/peers/" + name + ".obj", {}),
                     ReadReference("peers/" + name + "_reference.csv")});
  return cases;
}

// Solves with the options, and adds rows for what the interpolants show and what exact irradiance gives.
StudyRow Measure(StudyLog& log, const Case& test, const PipelineOptions& options, const std::string& setting,
                 double parameter, int repeats) {
  std::vector<double> seconds;
  std::unique_ptr<Pipeline> pipeline;
  for (int i = 0; i < repeats; ++i) {
    pipeline = std::make_unique<Pipeline>(test.scene, options);
    const Stopwatch stopwatch;
    pipeline->Solve({});
    pipeline->BuildMesh(MeshKind::kInterpolant, {});
    seconds.push_back(stopwatch.Seconds());
  }
  std::sort(seconds.begin(), seconds.end());
  const Shown shown = Compare(*pipeline, test.points);
  const PipelineReport& report = pipeline->report();

  StudyRow row;
  row.scene = test.name;
  row.method = "penumbra";
  row.setting = setting;
  row.parameter = parameter;
  row.seconds = seconds[seconds.size() / 2];
  row.elements = report.counts.elements;
  row.links = report.counts.links;
  row.triangles = report.counts.triangles;
  row.evaluations = report.counts.point_evaluations;
  SetErrors(shown.interpolated, &row);
  log.Add(row);

  StudyRow exact;
  exact.scene = test.name;
  exact.method = "penumbra, exact probe";
  exact.setting = setting;
  exact.parameter = parameter;
  for (const Phase& phase : report.phases)
    if (phase.name == "link" || phase.name == "iterate")
      exact.seconds = (std::isnan(exact.seconds) ? 0 : exact.seconds) + phase.seconds;
  SetErrors(shown.exact, &exact);
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

void Run(StudyLog& log) {
  if (!log.quick()) AddPeers(log);
  for (const Case& test : Cases(log.quick())) {
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
    PipelineOptions thesis;
    thesis.eps = 0.1;
    thesis.max_leaf_dsets = 10;
    thesis.min_discontinuity_weight = 100;
    thesis.max_corrections = 0;
    thesis.relative_cutoff = 1e-3;
    const StudyRow row = Measure(log, test, thesis, "thesis, chapter 7", StudyRow::kNone, 3);
    constexpr double kThesisSeconds = 2.5 * 3600;  // "two and a half hours of CPU time" for the interpolants
    log.Find(fmt::format(
        "The thesis's settings on our office: {} triangles in {:.2g} s, {:.0f} times less than the "
        "thesis's two and a half hours for its 6,576 in 1996.",
        *row.triangles, row.seconds, kThesisSeconds / row.seconds));
  }
}

}  // namespace

extern const Study kWholeSystemStudy;
const Study kWholeSystemStudy = {"whole-system",
                                 "Seconds against the error of what is shown, at the points of path-traced "
                                 "references; errors beyond two of their "
                                 "standard errors",
                                 "One number, the error that a user names, is met for the whole light, "
                                 "faster than other programs reach it.",
                                 "seconds",
                                 "error_p95",
                                 Run};

}  // namespace penumbra
