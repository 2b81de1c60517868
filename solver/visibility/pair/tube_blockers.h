// solver/visibility/pair/tube_blockers.h
//
// Finds the blockers that may lie between two polygons. The list of blockers of a pair of patches is computed
// once; the list for a pair of parts of these patches is filtered from the list of a pair of larger parts
// that contain them.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_hierarchy.h"

namespace penumbra {

// The ends of a tube (convex hull of two polygons): the parts of a receiver and of a source that lie in front
// of each other's planes.
struct TubeEnds {
  Polygon3 receiver, source;
  bool receiver_clipped = false;  // true if a part of the receiver lies behind the source's plane
};

// Clips two convex polygons, in the planes of `receiver_patch` and `source_patch`, to the parts that lie in
// front of each other's planes. Returns nullopt if one of the two polygons lies, up to rounding, in or behind
// the plane of the other.
std::optional<TubeEnds> ClipToEachOther(std::span<const Vec3> receiver, const Patch& receiver_patch,
                                        std::span<const Vec3> source, const Patch& source_patch);

// Appends to `blockers` the candidates that intersect the interior of the tube, in the order of the
// candidates; the patches `receiver` and `source` are skipped. Every candidate that blocks light between the
// ends of the tube is appended. Returns false and appends nothing if one candidate or walls (HiddenByWalls)
// hide the ends of the tube from each other completely.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, std::vector<PatchId>& blockers);
// Like FindTubeBlockers() with a list of candidates, but all patches of the hierarchy are candidates, and the
// appended blockers are in ascending order.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      const PatchHierarchy& hierarchy, std::vector<PatchId>& blockers);

struct TubeBlockers {
  std::vector<PatchId> all;
  // A subset of `all` that contains at least one blocker of every blocked segment between the ends of the
  // tube (KeepBlockersOfBeams).
  std::vector<PatchId> first;
};

// Like FindTubeBlockers() with a list of candidates, but sets both lists of `found`, TubeBlockers::all and
// TubeBlockers::first. Both lists are empty if the ends of the tube are hidden from each other.
bool FindTubeBlockers(const Scene& scene, const TubeEnds& ends, PatchId receiver, PatchId source,
                      std::span<const PatchId> candidates, TubeBlockers& found);

}  // namespace penumbra
