// solver/visibility/pair/tube_blockers.h
//
// What may stand between two polygons, found once for patches and then filtered for every smaller pair below
// them.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_hierarchy.h"

namespace penumbra {

// The parts of a receiver and a source before each other's planes: what light can pass between.
struct TubeEnds {
  Polygon3 receiver, source;
  bool receiver_clipped = false;  // part of the receiver lies behind the source's plane
};

// The ends of the tube from a convex polygon in the plane of `receiver_patch` to one in that of
// `source_patch`; nothing if one of them lies behind the other's plane, or in it but for rounding.
std::optional<TubeEnds> ClipToEachOther(std::span<const Vec3> receiver, const Patch& receiver_patch,
                                        std::span<const Vec3> source, const Patch& source_patch);

// Appends those candidates that meet the interior of the tube; the two patches themselves are left out. Never
// leaves out a true blocker. False, with nothing appended, if the ends are found to be hidden from each other
// wholly: by one candidate, or by walls (HiddenByWalls).
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers);
// The same with all patches of the hierarchy as candidates; blockers ascend.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers);

struct TubeBlockers {
  std::vector<PatchId> all;
  // As many of them as tell which segments between the ends are blocked: of what stands in a blocked
  // segment's way one at least is there, walls first (KeepBlockersOfBeams).
  std::vector<PatchId> first;
};

// The same, with the blockers in place of what `found` held; none where the ends are hidden from each other.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, TubeBlockers& found);

}  // namespace penumbra
