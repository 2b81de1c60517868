// solver/visibility/pair/beams.h
//
// The part of a tube that walls leave open. Several blockers in one plane, such as the parts of a wall around
// a doorway, may together hide one end of the tube from the other although no single blocker does. Every
// visible segment between the tube's ends crosses the plane of a wall in one of the wall's openings. The
// openings of successive walls divide the tube into narrower beams (like the portals and antipenumbras of
// Teller 1992, but without cells).

#pragma once

#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// All segments between the ends of a tube that pass through one opening of each of several walls: the
// segments that start in the first polygon of `stations`, end in the last one, and cross all others. Each
// polygon is convex.
struct Beam {
  std::vector<Polygon3> stations;
};

struct Beams {
  std::vector<Beam> beams;          // contain every segment that no wall cuts
  std::vector<PatchId> wall_parts;  // the blockers that form these walls, ascending
  bool hidden() const { return beams.empty(); }
};

// The beams from `a` to `b` through the walls that the blockers form in planes between them. Only walls that
// hide a large fraction of the tube are used. Openings narrower than kCrack times the largest coordinate
// count as closed: rounding leaves such cracks between polygons that touch. REQUIRES: `a` and `b` are convex,
// and each lies before the plane of the other.
Beams FindBeams(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                std::span<const PatchId> blockers);

// True if FindBeams() would find no beam. HiddenByWalls() is faster than FindBeams(), because it stops at the
// first beam.
bool HiddenByWalls(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                   std::span<const PatchId> blockers);

// Removes the blockers that neither belong to a wall of `beams` nor reach into a beam. Every blocked segment
// between the tube's ends keeps at least one of its blockers. The order of the blockers does not change.
void KeepBlockersOfBeams(const Scene& scene, const Beams& beams, std::vector<PatchId>& blockers);

}  // namespace penumbra
