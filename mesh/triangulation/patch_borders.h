// mesh/triangulation/patch_borders.h
//
// The vertices on the borders of the leaves of a patch's quadtree. Each corner of a leaf is a border vertex,
// including hanging vertices: corners that lie in the interior of a larger leaf's side. Each crossing of a
// border with a discontinuity line that is active in one of the two adjacent leaves is also a border vertex.
// The two leaves at a border use the same positions of border vertices (thesis 3.6, cases A and B).

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/discontinuities/dset.h"
#include "solver/geometry/polygon.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

class PatchBorders {
 public:
  using VertexId = std::uint32_t;

  PatchBorders() = default;
  // REQUIRES: the quadtree is balanced, and has not changed since `dsets` were computed.
  PatchBorders(const ElementForest& forest, PatchId patch, const PatchDSets& dsets);

  // Replaces the contents of `loop` by the vertices around a leaf, counter-clockwise. `leaf` is an index in
  // PatchDSets::leaves.
  void Around(std::size_t leaf, std::vector<VertexId>& loop) const;

  // The positions of the vertices on the patch's outline [m].
  std::vector<Vec3> OutlineVertices() const;
  // Adds all points in `points` that lie on the patch's outline as vertices of the outline. If a vertex of
  // the outline lies within SnapDistance() of an added point, so that the two count as one point, the vertex
  // moves to the added point. All other vertices of the patch's outline keep their positions.
  void Weld(std::span<const Vec3> points);

  std::vector<Vec3> positions;  // position of each vertex [m], indexed by VertexId
  std::vector<Vec2> in_plane;   // position of each vertex in the patch's frame [m]
  Frame frame;
  double snap = 0;  // SnapDistance() of the patch, within which points count as one point [m]

 private:
  // A stretch is the part of a leaf's border between two successive corners of leaves. The two leaves on both
  // sides of a stretch (part of a leaf's border) refer to the same Stretch object.
  struct Stretch {
    VertexId a, b;  // end points of the stretch (part of a border); `a` has the smaller lattice point
    // The points where discontinuity lines cross the border between a and b: for each point, (distance from
    // a) / (distance from a to b), and the number of the line.
    std::vector<std::pair<double, std::int32_t>> crossings;
    // The border vertices strictly between a and b, ordered from a to b.
    std::vector<VertexId> inner;
    // The number of leaves on whose border the stretch lies: 1 on the patch's outline, otherwise 2.
    int uses = 0;
  };
  struct StretchUse {
    std::uint32_t stretch;
    bool reversed;
  };
  class Builder;

  VertexId AddBetween(const Stretch& stretch, double fraction);
  void WeldTo(Stretch& stretch, const Vec3& point);

  std::vector<Stretch> stretches_;
  // For each leaf, the stretches (parts of the leaf's border), counter-clockwise.
  std::vector<std::vector<StretchUse>> uses_;
};

}  // namespace penumbra
