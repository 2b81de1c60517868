// What discontinuities are worth (thesis 5.2, 5.3, 8.2): ways to choose them and to weigh them, against the
// error of the interpolants.
//
// All ways start from the same solution and the same leaves, and see the same discontinuities; no leaf is
// divided for errors, and for crowding only where the way says so. A random choice weighs none of them.
// Seconds are processor time of finding, triangulating and interpolating, so that they can be compared on a
// machine that does other things too; of passes that take milliseconds, the least of several.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

struct Way {
  const char* name;
  std::string_view choice;
  DiscontinuityWeight weight;
  bool split_crowded = false;
  double share = 1;  // of a random choice
};
constexpr Way kNone = {"none", "none", DiscontinuityWeight::kIrradiance};
constexpr Way kAll = {"all", "all", DiscontinuityWeight::kIrradiance};
// A random choice comes before those that are compared with it.
constexpr std::array kBudgeted = {
    Way{"random", "random", DiscontinuityWeight::kIrradiance},
    Way{"ranked, irradiance", "ranked", DiscontinuityWeight::kIrradiance},
    Way{"ranked, thesis", "ranked", DiscontinuityWeight::kThesis},
    Way{"adaptive", "adaptive", DiscontinuityWeight::kIrradiance},
    Way{"random, crowded leaves split", "random", DiscontinuityWeight::kIrradiance, true},
    Way{"ranked, irradiance, crowded leaves split", "ranked", DiscontinuityWeight::kIrradiance, true}};
constexpr std::array kBudgets = {5, 10, 20};
constexpr std::uint64_t kSeeds = 3;  // of random choices
// What a random choice can do in less time than all that a budget allows: look at a part of the
// discontinuities, with the largest of the budgets.
constexpr std::array kShares = {0.25, 0.5, 0.75};

class Measurement {
 public:
  Measurement(StudyLog& log, const std::string& name)
      : log_(log), name_(name), scene_(*LoadBuiltinScene(name, {})), pipeline_(scene_, Options(log.quick())) {
    pipeline_.Solve({});
    // Discontinuities that would not count at the error asked for may well count together.
    PipelineOptions finer;
    finer.error = kWeightError;
    finer.refine = RefineBy::kTransport;  // nothing will ask for more
    for (const DiscontinuityWeight weight :
         {DiscontinuityWeight::kThesis, DiscontinuityWeight::kIrradiance}) {
      finer.weight = weight;
      (weight == DiscontinuityWeight::kThesis ? thesis_ : irradiance_) =
          Resolve(scene_, finer).discontinuities.min_weight;
    }
  }

  StudyRow Measure(const Way& way, int budget, std::uint64_t seed = 1) {
    MeshOptions options;
    options.discontinuities.choice = way.choice;
    options.discontinuities.weight = way.weight;
    options.discontinuities.min_weight = way.weight == DiscontinuityWeight::kThesis ? thesis_ : irradiance_;
    options.discontinuities.max_leaf_dsets = budget;
    options.discontinuities.seed = seed;
    options.discontinuities.random_share = way.share;
    if (way.split_crowded) {
      const DiscontinuityOptions& resolved = pipeline_.resolved().discontinuities;
      options.discontinuities.crowded_splits = resolved.crowded_splits;
      options.discontinuities.min_split_area = resolved.min_split_area;
    }
    const auto sampler = [this](PatchId patch, const ReceiverPoint& at) {
      return pipeline_.irradiance().OnPatch(patch, at);
    };
    pipeline_.irradiance();  // is made once
    StudyRow row;
    MeshResult mesh;
    row.seconds = std::numeric_limits<double>::infinity();
    const double first = ProcessorSeconds();
    do {
      const double begin = ProcessorSeconds();
      mesh = RunLocalPass(pipeline_.visibility(), pipeline_.solution(), sampler, options, {});
      row.seconds = std::min(row.seconds, ProcessorSeconds() - begin);
    } while (!log_.quick() && ProcessorSeconds() - first < kLeastSeconds);
    const RepresentationError error =
        MeasureRepresentationError(scene_, mesh.mesh, sampler, log_.quick() ? 200 : kPoints, 1);
    row.scene = name_;
    row.method = way.name;
    row.setting = budget > 0 && way.choice != "all" ? fmt::format("{} a leaf", budget) : way.name;
    if (way.share < 1) row.setting += fmt::format(", {:g} of all", way.share);
    if (way.choice == "random") row.setting += fmt::format(", seed {}", seed);
    row.parameter = budget;
    CopyErrors(error, &row);
    row.elements = mesh.report.counts.dsets_active;
    row.triangles = mesh.report.counts.triangles;
    row.evaluations = mesh.report.counts.point_evaluations;
    log_.Add(row);
    return row;
  }

 private:
  static constexpr double kWeightError = 0.005;
  static constexpr std::size_t kPoints = 10'000;
  static constexpr double kLeastSeconds = 0.1;  // of the processor, for one row

  static PipelineOptions Options(bool quick) {
    PipelineOptions options;
    options.error = quick ? 0.3 : 0.05;
    return options;
  }

  StudyLog& log_;
  std::string name_;
  Scene scene_;
  Pipeline pipeline_;
  double thesis_ = 0, irradiance_ = 0;
};

// The error that is looked at: the rms, which few points in the dark can decide, or the 99th percentile.
using ErrorMeasure = double (*)(const StudyRow&);
double Rms(const StudyRow& row) { return row.error_rms; }
double P99(const StudyRow& row) { return row.error_p99; }

// The error that a way of several settings reaches in so many seconds: between them straight in the
// logarithms, beyond the first and the last as there.
double ErrorAt(std::vector<StudyRow> rows, ErrorMeasure measure, double seconds) {
  std::sort(rows.begin(), rows.end(),
            [](const StudyRow& a, const StudyRow& b) { return a.seconds < b.seconds; });
  if (seconds <= rows.front().seconds) return measure(rows.front());
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    if (seconds > rows[i + 1].seconds) continue;
    const double t = std::log(seconds / rows[i].seconds) / std::log(rows[i + 1].seconds / rows[i].seconds);
    return std::exp((1 - t) * std::log(measure(rows[i])) + t * std::log(measure(rows[i + 1])));
  }
  return measure(rows.back());
}

// The error that all or nothing reaches in so many seconds. There is no setting between the two: what can be
// had is all of them in some leaves, chosen at random, and none in the others. Seconds and squares of errors
// are both linear in the share.
double AllOrNothingAt(const StudyRow& none, const StudyRow& all, double seconds) {
  const double share = std::clamp((seconds - none.seconds) / (all.seconds - none.seconds), 0.0, 1.0);
  return std::sqrt((1 - share) * none.error_rms * none.error_rms + share * all.error_rms * all.error_rms);
}

// Several random choices with the same budget as one: means of seconds, of 99th percentiles and of squares of
// errors.
StudyRow MeanOf(const std::vector<StudyRow>& rows) {
  StudyRow mean = rows.front();
  mean.seconds = mean.error_rms = mean.error_p99 = 0;
  for (const StudyRow& row : rows) {
    mean.seconds += row.seconds / static_cast<double>(rows.size());
    mean.error_p99 += row.error_p99 / static_cast<double>(rows.size());
    mean.error_rms += row.error_rms * row.error_rms / static_cast<double>(rows.size());
  }
  mean.error_rms = std::sqrt(mean.error_rms);
  return mean;
}

// The mesh of the office at the thesis's settings, beside what the thesis tells of its own (5.5, 7.1).
void MeasureThesisMesh(StudyLog& log) {
  const Scene scene = *LoadBuiltinScene("office", {});
  Pipeline pipeline(scene, ThesisSettings());
  pipeline.Solve({});
  const RadiositySolution& solution = pipeline.solution();
  MeshReport report;
  PatchTriangulator(pipeline.visibility(), solution, pipeline.resolved().discontinuities, {})
      .Triangulate({solution.forest, {}}, report);
  std::size_t leaves = 0;
  for (const Element& element : solution.forest.elements()) leaves += element.IsLeaf() ? 1 : 0;
  constexpr std::size_t kThesisLeaves = 1622, kThesisTriangles = 6576, kThesisMerged = 103;
  log.Find(
      fmt::format("The thesis's settings on our office: {} leaves, {} of them split since they were crowded, "
                  "{} triangles, at most {} discontinuities in one edge; the thesis has {}, {} and {} on "
                  "its own office.",
                  leaves, report.counts.leaves_split, report.counts.triangles, report.counts.most_merged,
                  kThesisLeaves, kThesisTriangles, kThesisMerged));
}

void CompareBudgets(StudyLog& log, const std::string& what, const std::vector<StudyRow>& rows,
                    const std::vector<StudyRow>& random, const StudyRow& none, const StudyRow& all) {
  int beats_random = 0, beats_in_p99 = 0, beats_all = 0;
  std::string ratios;
  for (const StudyRow& row : rows) {
    const double to_random = row.error_rms / ErrorAt(random, Rms, row.seconds);
    const double in_p99 = row.error_p99 / ErrorAt(random, P99, row.seconds);
    const double to_all = row.error_rms / AllOrNothingAt(none, all, row.seconds);
    beats_random += to_random < 1 ? 1 : 0;
    beats_in_p99 += in_p99 < 1 ? 1 : 0;
    beats_all += to_all < 1 ? 1 : 0;
    ratios += fmt::format("{}{:.2f}/{:.2f}/{:.2f}", ratios.empty() ? "" : ", ", to_random, in_p99, to_all);
  }
  log.Find(
      fmt::format("{}: of {} budgets {} err less (rms) than random choice in equal time, {} less in the 99th "
                  "percentile, {} less (rms) than all or nothing; the ratios are {}.",
                  what, rows.size(), beats_random, beats_in_p99, beats_all, ratios));
}

std::span<const int> Budgets(bool quick) { return std::span(kBudgets).first(quick ? 1 : kBudgets.size()); }

// The random choice with every budget, and of a part of the discontinuities.
std::vector<StudyRow> MeasureRandom(Measurement& measurement, Way way, bool quick) {
  std::vector<StudyRow> rows;
  const auto measure = [&](int budget) {
    std::vector<StudyRow> measured;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
      measured.push_back(measurement.Measure(way, budget, seed));
    rows.push_back(MeanOf(measured));
  };
  for (const int budget : Budgets(quick)) measure(budget);
  for (const double share : kShares) {
    way.share = share;
    measure(Budgets(quick).back());
  }
  return rows;
}

void StudyDiscontinuities(StudyLog& log) {
  for (const std::string name : {"floating-cube", "office", "blind"}) {
    if (log.quick() && name != "floating-cube") break;
    Measurement measurement(log, name);
    const StudyRow none = measurement.Measure(kNone, 0), all = measurement.Measure(kAll, 0);
    std::vector<StudyRow> random;
    for (const Way& way : kBudgeted) {
      if (way.choice == "random") {
        random = MeasureRandom(measurement, way, log.quick());
        random.push_back(none);  // it begins with no discontinuities, as all do
        continue;
      }
      std::vector<StudyRow> rows;
      for (const int budget : Budgets(log.quick())) rows.push_back(measurement.Measure(way, budget));
      CompareBudgets(log, name + ", " + way.name, rows, random, none, all);
    }
  }
  if (!log.quick()) MeasureThesisMesh(log);
}

}  // namespace

extern const Study kDiscontinuityStudy;
const Study kDiscontinuityStudy = {"discontinuities",
                                   "Processor seconds of the local pass against the error of the "
                                   "interpolants, by choice, weight and number of "
                                   "discontinuities a leaf (elements: active DSets)",
                                   "Ranked discontinuities lower the error faster than a random choice of "
                                   "them, and than all or none of them "
                                   "(thesis 5.2, 5.3).",
                                   "seconds",
                                   "error_rms",
                                   StudyDiscontinuities};

}  // namespace penumbra
