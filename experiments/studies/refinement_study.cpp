// Refinement by transport error, by representation error and by both: mesh, evaluations and seconds against
// the error of what is shown.

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "experiments/studies/reference_case.h"
#include "experiments/studies/study.h"

namespace penumbra {
namespace {

struct Refined {
  const char* name;
  RefineBy refine;
};
constexpr Refined kRefined[] = {{"transport", RefineBy::kTransport},
                                {"representation", RefineBy::kRepresentation},
                                {"both", RefineBy::kBoth}};

// Of the rows whose 99th percentile is at most `wanted`, the one with the fewest seconds.
const StudyRow* Cheapest(const std::vector<StudyRow>& rows, const std::string& scene, const char* method,
                         double wanted) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : rows)
    if (row.scene == scene && row.method == method && row.error_p99 <= wanted &&
        (!best || row.seconds < best->seconds))
      best = &row;
  return best;
}

void Conclude(StudyLog& log, const std::string& scene) {
  for (const double wanted : {0.05, 0.02, 0.01})
    for (const Refined& method : kRefined) {
      const StudyRow* row = Cheapest(log.rows(), scene, method.name, wanted);
      log.Find(row ? fmt::format("{}: {} reaches {:g} with {} ({:.2g} s, {} triangles, {} evaluations).",
                                 scene, method.name, wanted, row->setting, row->seconds, *row->triangles,
                                 *row->evaluations)
                   : fmt::format("{}: {} did not reach {:g}.", scene, method.name, wanted));
    }
}

void StudyRefinement(StudyLog& log) {
  std::vector<std::string> names = {"floating-cube", "cornell", "box_grey", "office"};
  if (log.quick()) names.resize(1);
  for (const std::string& name : names) {
    const ReferenceCase test = LoadReferenceCase(name);
    for (const Refined& method : kRefined)
      for (const double error :
           log.quick() ? std::vector<double>{0.1} : std::vector<double>{0.1, 0.05, 0.02, 0.01, 0.005}) {
        if (name == "office" && error < 0.02) continue;
        PipelineOptions options;
        options.error = error;
        options.refine = method.refine;
        StudyRow row = MeasurePipeline(test, options, 1).row;
        row.method = method.name;
        row.setting = fmt::format("--error {:g}", error);
        row.parameter = error;
        log.Add(std::move(row));
      }
    if (!log.quick()) Conclude(log, name);
  }
}

}  // namespace

extern const Study kRefinementStudy;
const Study kRefinementStudy = {
    "refinement",
    "Refinement by transport, by representation and by both: the error of what is shown, at the points of "
    "path-traced references, beyond two of their standard errors; seconds of processors",
    "Representation-based refinement gives a better mesh for its size, and costs too many evaluations to be "
    "practical (Hardt 1996, 4.4.2).",
    "seconds",
    "error_p99",
    StudyRefinement};

}  // namespace penumbra
