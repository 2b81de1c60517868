// mesh/triangulation/patch_borders.h
//
// The vertices on the borders of the leaves of a patch's quadtree. Each corner of a leaf is a border vertex,
// including corners that hang on the side of a larger leaf. Each crossing of a border with a discontinuity
// line that is active in one of the two adjacent leaves is also a border vertex. The two leaves at a border
// use the same positions of border vertices (thesis 3.6, cases A and B).

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
  // the outline lies within the snap distance of an added point, the vertex moves to this point. All other
  // vertices of the patch's outline keep their positions.
  void Weld(std::span<const Vec3> points);

  std::vector<Vec3> positions;  // position of each vertex [m], by VertexId
  std::vector<Vec2> in_plane;   // position of each vertex in the patch's frame [m]
  Frame frame;
  double snap = 0;  // snap distance of the patch [m]

 private:
  // A stretch is the part of a leaf's border between two successive corners of leaves. The leaves on both
  // sides of a stretch refer to the same Stretch object.
  struct Stretch {
    VertexId a, b;  // ends of the stretch, at ascending lattice points
    // Crossings with discontinuity lines: the fraction of the way from a to b, and the number of the line.
    std::vector<std::pair<double, std::int32_t>> crossings;
    std::vector<VertexId> inner;  // vertices between a and b, ordered from a to b
    int uses = 0;                 // number of leaves along the stretch; 1 on the patch's outline
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
