#include "solver/visibility/pair/tube_blockers.h"

#include <algorithm>

#include "solver/base/scratch.h"
#include "solver/visibility/pair/beams.h"
#include "solver/visibility/pair/tube.h"

namespace penumbra {
namespace {

// One blocker hides all or is no wall.
constexpr std::size_t kFewestOfWalls = 2;

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

// False, with nothing appended, if one candidate hides the ends from each other.
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

// The same, and false if walls hide them.
bool FindInTube(const Scene& scene, const Tube& tube, const TubeEnds& ends, PatchId receiver, PatchId source,
                std::span<const PatchId> candidates, std::vector<PatchId>& blockers) {
  const std::size_t before = blockers.size();
  if (!FilterByTube(scene, tube, receiver, source, candidates, blockers)) return false;
  if (blockers.size() < before + kFewestOfWalls ||
      !HiddenByWalls(scene, ends.receiver, ends.source, std::span(blockers).subspan(before)))
    return true;
  blockers.resize(before);
  return false;
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
         FindInTube(scene, Tube(ends.receiver, ends.source), ends, receiver, source, candidates, blockers);
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers) {
  const Tube tube(ends.receiver, ends.source);
  const Scratch<std::vector<PatchId>> candidates;
  hierarchy.Find(tube.Region(), {}, *candidates);
  return FindInTube(scene, tube, ends, receiver, source, *candidates, blockers);
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers,
                      std::vector<PatchId>& first) {
  first.clear();
  if (candidates.empty()) return true;
  const Tube tube(ends.receiver, ends.source);
  if (!FilterByTube(scene, tube, receiver, source, candidates, first)) return false;
  const std::size_t before = blockers.size();
  blockers.insert(blockers.end(), first.begin(), first.end());
  if (first.size() < kFewestOfWalls) return true;
  const Beams beams = FindBeams(scene, ends.receiver, ends.source, first);
  if (beams.hidden()) {
    blockers.resize(before);
    first.clear();
    return false;
  }
  KeepBlockersOfBeams(scene, beams, first);
  return true;
}

}  // namespace penumbra
