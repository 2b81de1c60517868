// solver/visibility/pair/tube_blockers.h
//
// The blockers that may stand between two polygons. The list of blockers of a pair of patches is computed
// once; the list of a pair of parts of these patches is filtered from the list of the larger pair that
// contains it.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_hierarchy.h"

namespace penumbra {

// The parts of a receiver and of a source that lie before each other's planes: the ends of a tube.
struct TubeEnds {
  Polygon3 receiver, source;
  bool receiver_clipped = false;  // a part of the receiver lies behind the source's plane
};

// The ends of the tube between a convex polygon in the plane of `receiver_patch` and one in the plane of
// `source_patch`. The result is nullopt if one polygon lies, up to rounding, in or behind the plane of the
// other.
std::optional<TubeEnds> ClipToEachOther(std::span<const Vec3> receiver, const Patch& receiver_patch,
                                        std::span<const Vec3> source, const Patch& source_patch);

// Appends to `blockers` the candidates that intersect the interior of the tube, in the order of the
// candidates; the two patches themselves are skipped. Every candidate that blocks light between the ends is
// appended. Returns false and appends nothing if one candidate or walls (HiddenByWalls) hide the ends from
// each other completely.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers);
// Like FindTubeBlockers() above, with all patches of the hierarchy as candidates; the blockers are in
// ascending order.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers);

struct TubeBlockers {
  std::vector<PatchId> all;
  // A subset that decides which segments between the ends are blocked: it contains at least one blocker of
  // every blocked segment (KeepBlockersOfBeams).
  std::vector<PatchId> first;
};

// Like FindTubeBlockers() above, but replaces the contents of `found` and computes both of its lists. Both
// lists are empty if the ends are hidden from each other.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, TubeBlockers& found);

}  // namespace penumbra
