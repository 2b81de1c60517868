// Growth: how time, links and memory grow with the rooms of a building.

#include <malloc.h>

#include <fstream>
#include <string>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "mesh/pipeline.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

// Begins to count the peak anew (Linux; where it cannot be told, the peak is that of the process so far, and
// buildings come in order of size).
void ForgetPeak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

// The most memory that this process has used since then [bytes].
std::size_t PeakBytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stoul(line.substr(6));  // given in KiB
  return 0;
}

struct Growth {
  double patches, processor, links, bytes;
};

// One building; corrections and interpolants come after the links where `whole` asks for them.
Growth SolveBuilding(StudyLog& log, int side, double error, bool whole) {
  const Scene scene = *LoadBuiltinScene(fmt::format("building-{0}x{0}", side), {});
  PipelineOptions options;
  options.error = error;
  options.refine = RefineBy::kTransport;
  if (!whole) options.max_corrections = 0;
  const ExecutionContext context;
  ForgetPeak();
  const Stopwatch stopwatch;
  const double begin = ProcessorSeconds();
  Pipeline pipeline(scene, options);
  pipeline.Solve(context);
  if (whole) pipeline.BuildMesh(MeshKind::kInterpolant, context);
  StudyRow row;
  row.seconds = stopwatch.Seconds();
  const Growth measured = {static_cast<double>(scene.patches.size()), ProcessorSeconds() - begin,
                           static_cast<double>(pipeline.report().counts.links),
                           static_cast<double>(PeakBytes())};
  const PipelineReport::Counts& counts = pipeline.report().counts;
  row.scene = scene.name;
  row.method = whole ? "links, corrections, interpolants" : "links";
  row.setting =
      fmt::format("error {:g}, {} rooms, {:.1f} s of processors", error, side * side, measured.processor);
  row.parameter = measured.patches;
  row.elements = counts.elements;
  row.links = counts.links;
  row.bytes = static_cast<std::size_t>(measured.bytes);
  if (whole) {
    row.triangles = counts.triangles;
    row.evaluations = counts.point_evaluations;
  }
  log.Add(row);
  return measured;
}

void Grow(StudyLog& log, const std::vector<int>& sides, double error, bool whole) {
  std::vector<double> patches, processor, links, bytes;
  for (const int side : sides) {
    const Growth measured = SolveBuilding(log, side, error, whole);
    patches.push_back(measured.patches);
    processor.push_back(measured.processor);
    links.push_back(measured.links);
    bytes.push_back(measured.bytes);
  }
  log.Find(fmt::format(
      "{}, {} to {} patches: seconds of processors grow as the power {:.2f} of the patches, links as "
      "{:.2f}, bytes as {:.2f}",
      whole ? "Whole solves" : "Links alone", patches.front(), patches.back(), LogSlope(patches, processor),
      LogSlope(patches, links), LogSlope(patches, bytes)));
}

void StudyGrowth(StudyLog& log) {
  if (log.quick()) return Grow(log, {1, 2}, 0.5, false);
  constexpr double kError = 0.05;
  Grow(log, {1, 2, 3, 5, 10}, kError, true);
  Grow(log, {1, 2, 3, 5, 10}, kError, false);
}

}  // namespace

extern const Study kGrowthStudy;
const Study kGrowthStudy = {
    "growth",
    "Growth of time, links and memory with the rooms of a building",
    "What a room costs depends on what it sees, not on the building around it: exponents in polygons stay "
    "below 1.5, 25 rooms take a minute and 100 rooms less than 4 GB.",
    "parameter",
    "seconds",
    StudyGrowth};

}  // namespace penumbra
