// solver/visibility/pair/tube_blockers.h
//
// The blockers that may stand between two polygons. Each pair of patches gets a list of blockers once; each
// pair of smaller polygons on the two patches filters the list of the pair above it.

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
// `source_patch`. Nothing if one polygon lies, up to rounding, in or behind the other's plane.
std::optional<TubeEnds> ClipToEachOther(std::span<const Vec3> receiver, const Patch& receiver_patch,
                                        std::span<const Vec3> source, const Patch& source_patch);

// Appends the candidates that meet the interior of the tube, in their order; the two patches themselves do
// not count. No candidate that blocks is missing. Returns false and appends nothing if one candidate or walls
// (HiddenByWalls) hide the ends from each other completely.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers);
// FindTubeBlockers() with all patches of the hierarchy as candidates; the blockers ascend.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers);

struct TubeBlockers {
  std::vector<PatchId> all;
  // A subset that decides which segments between the ends are blocked: it contains at least one blocker of
  // every blocked segment (KeepBlockersOfBeams).
  std::vector<PatchId> first;
};

// FindTubeBlockers() for both lists; replaces the contents of `found`. Both lists are empty if the ends are
// hidden from each other.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, TubeBlockers& found);

}  // namespace penumbra
