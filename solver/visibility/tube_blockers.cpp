#include "solver/visibility/tube_blockers.h"

#include <algorithm>

#include "solver/visibility/tube.h"

namespace penumbra {
namespace {

// Of a height above a plane, relative to the coordinates: what rounding of vertices and normal can make of
// zero. Polygons that see each other only by less than this lie in one plane.
constexpr double kCoplanar = 1e-12;

// The part of the polygon before the patch's plane; empty if that is nothing beyond rounding.
Polygon3 PartBefore(std::span<const Vec3> polygon, const Patch& patch, bool* clipped) {
  double lowest = 0, highest = 0, scale = patch.extent;
  for (const Vec3& v : polygon) {
    const double height = patch.normal.dot(v - patch.vertex[0]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    scale = std::max(scale, MaxAbs(v));
  }
  *clipped = lowest < -kCoplanar * scale;
  if (highest <= kCoplanar * scale) return {};
  if (!*clipped) return {polygon.begin(), polygon.end()};
  return ClipToHalfSpace(polygon, patch.normal, patch.vertex[0], kCoplanar * scale);
}

bool FilterByTube(const Scene& scene, const Tube& tube, PatchId receiver, PatchId source,
                  std::span<const PatchId> candidates, std::vector<PatchId>& blockers) {
  const std::size_t before = blockers.size();
  for (const PatchId candidate : candidates) {
    if (candidate == receiver || candidate == source) continue;
    const Patch& patch = scene.patches[candidate];
    if (tube.Misses(patch.Vertices(), patch.normal)) continue;
    if (tube.HiddenBy(patch.Vertices(), patch.normal)) {
      blockers.resize(before);
      return false;
    }
    blockers.push_back(candidate);
  }
  return true;
}

}  // namespace

std::optional<TubeEnds> ClipToEachOther(std::span<const Vec3> receiver, const Patch& receiver_patch,
                                        std::span<const Vec3> source, const Patch& source_patch) {
  TubeEnds ends;
  bool source_clipped = false;
  ends.receiver = PartBefore(receiver, source_patch, &ends.receiver_clipped);
  if (ends.receiver.empty()) return std::nullopt;
  ends.source = PartBefore(source, receiver_patch, &source_clipped);
  if (ends.source.empty()) return std::nullopt;
  return ends;
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers) {
  return candidates.empty() ||
         FilterByTube(scene, Tube(ends.receiver, ends.source), receiver, source, candidates, blockers);
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers) {
  const Tube tube(ends.receiver, ends.source);
  thread_local std::vector<PatchId> candidates;
  hierarchy.Find(tube.Region(), {}, candidates);
  return FilterByTube(scene, tube, receiver, source, candidates, blockers);
}

}  // namespace penumbra
