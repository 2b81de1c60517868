#include "solver/visibility/pair/tube_blockers.h"

#include <algorithm>

#include "solver/base/scratch.h"
#include "solver/visibility/pair/beams.h"
#include "solver/visibility/pair/tube.h"

namespace penumbra {
namespace {

// A wall has at least two parts: a single blocker either hides everything or is no wall.
constexpr std::size_t kFewestOfWalls = 2;

// The part of the polygon before the patch's plane; empty if there is none up to rounding.
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

// Finds the blockers in one tube.
struct TubeSearch {
  const Scene& scene;
  const Tube& tube;
  const TubeEnds& ends;
  PatchId receiver, source;

  // Appends the candidates that meet the tube. False, with nothing appended, if one candidate hides the ends
  // from each other.
  bool Filter(std::span<const PatchId> candidates, std::vector<PatchId>& blockers) const {
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

  // Filter() that also returns false if walls hide the ends from each other.
  bool Find(std::span<const PatchId> candidates, std::vector<PatchId>& blockers) const {
    const std::size_t before = blockers.size();
    if (!Filter(candidates, blockers)) return false;
    if (blockers.size() < before + kFewestOfWalls ||
        !HiddenByWalls(scene, ends.receiver, ends.source, std::span(blockers).subspan(before)))
      return true;
    blockers.resize(before);
    return false;
  }
};

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
  if (candidates.empty()) return true;
  const Tube tube(ends.receiver, ends.source);
  return TubeSearch{scene, tube, ends, receiver, source}.Find(candidates, blockers);
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers) {
  const Tube tube(ends.receiver, ends.source);
  const Scratch<std::vector<PatchId>> candidates;
  hierarchy.Find(tube.Region(), {}, *candidates);
  return TubeSearch{scene, tube, ends, receiver, source}.Find(*candidates, blockers);
}

bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, TubeBlockers& found) {
  found.all.clear();
  found.first.clear();
  if (candidates.empty()) return true;
  const Tube tube(ends.receiver, ends.source);
  if (!TubeSearch{scene, tube, ends, receiver, source}.Filter(candidates, found.all)) return false;
  found.first = found.all;
  if (found.all.size() < kFewestOfWalls) return true;
  const Beams beams = FindBeams(scene, ends.receiver, ends.source, found.first);
  if (beams.hidden()) {
    found.all.clear();
    found.first.clear();
    return false;
  }
  KeepBlockersOfBeams(scene, beams, found.first);
  return true;
}

}  // namespace penumbra
