// solver/visibility/pair/beams.h
//
// What walls leave of a tube. Blockers in one plane, such as the parts of a wall around a doorway, hide
// together what none of them hides alone: every segment between the tube's ends crosses their plane where
// none of them is. Those openings, plane after plane, leave beams of the tube, each narrower than the whole
// (the portals and antipenumbras of Teller 1992, found without cells).

#pragma once

#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Segments between the ends of a tube that pass openings in its walls: they go from the first polygon to the
// last through all others, each convex.
struct Beam {
  std::vector<Polygon3> stations;
};

struct Beams {
  std::vector<Beam> beams;          // together they hold all segments that no wall cuts
  std::vector<PatchId> wall_parts;  // the blockers that make these walls, ascending
  bool hidden() const { return beams.empty(); }
};

// The beams from `a` to `b`, convex polygons each before the other's plane, past those of the blockers that
// lie in planes between them. A wall counts where it hides most of what reaches it. Openings no wider than
// kCrack of the coordinates are closed: rounding leaves such cracks between polygons that touch.
Beams FindBeams(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                std::span<const PatchId> blockers);

// Whether those walls leave nothing: the same, but ends at the first beam.
bool HiddenByWalls(const Scene& scene, std::span<const Vec3> a, std::span<const Vec3> b,
                   std::span<const PatchId> blockers);

// Of the tube's blockers those that a segment between its ends may meet first: walls, and what reaches into
// a beam. Of every segment that is blocked one blocker is kept. Ascending if `blockers` are.
void KeepBlockersOfBeams(const Scene& scene, const Beams& beams, std::vector<PatchId>& blockers);

}  // namespace penumbra
