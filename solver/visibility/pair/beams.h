// solver/visibility/pair/beams.h
//
// Beams: the parts of a tube (convex hull of two polygons) that walls leave open. Several blockers in one
// plane, such as the parts of a wall around a doorway, may together hide one end of the tube from the other
// although no single blocker does. Every unblocked segment between the tube's ends crosses the plane of a
// wall in one of the openings of the wall. The openings of successive walls divide the tube into narrower
// beams (like the portals and antipenumbras of Teller 1992, but without cells).

#pragma once

#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A beam is the set of all segments between the ends of a tube that pass through one opening of each of
// several walls. The list `stations` holds convex polygons: the segments of the beam start in the first
// polygon, end in the last polygon, and cross all other polygons.
struct Beam {
  std::vector<Polygon3> stations;
};

struct Beams {
  std::vector<Beam> beams;  // together, the beams contain every segment between the ends that no wall blocks
  std::vector<PatchId> wall_parts;  // the indices of the blockers that form the walls, in ascending order
  bool hidden() const { return beams.empty(); }
};

// Finds the beams from polygon `a` to polygon `b` through the openings of the walls that the blockers form
// between `a` and `b`. Only walls that hide a large fraction of the tube are used. Openings narrower than
// kCrack * (largest coordinate) count as closed, because rounding leaves cracks of this width between
// polygons that touch. REQUIRES: `a` and `b` are convex, and each lies in front of the plane of the other.
Beams FindBeams(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                std::span<const PatchId> blockers);

// True if walls hide polygon `a` from polygon `b` completely, so that FindBeams() would find no beam.
// HiddenByWalls() is faster than FindBeams(), because it stops at the first beam.
bool HiddenByWalls(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                   std::span<const PatchId> blockers);

// Removes the blockers that neither belong to a wall of `beams` nor reach into a beam. For every blocked
// segment between the tube's ends, at least one blocker remains in the list. Blockers that are not removed
// keep their order in the list.
void KeepBlockersOfBeams(const Scene& scene, const Beams& beams, std::vector<PatchId>& blockers);

}  // namespace penumbra
