// mesh/triangulation/patch_borders.h
//
// The vertices on the borders of a patch's leaves: the corners of leaves, including hanging corners, and the
// crossings of each stretch between two corners with the lines that are active in either leaf. Each vertex
// has one position, which both leaves use (thesis 3.6, cases A and B).

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

  // Replaces `loop` by the vertices around a leaf, counter-clockwise. `leaf` is an index in
  // PatchDSets::leaves.
  void Around(std::size_t leaf, std::vector<VertexId>& loop) const;

  // The positions of the vertices on the patch's outline [m].
  std::vector<Vec3> OutlineVertices() const;
  // Adds to the outline those of the points that lie on it. A vertex within the snap distance of such a point
  // moves to the point. Other vertices stay in place.
  void Weld(std::span<const Vec3> points);

  std::vector<Vec3> positions;  // [m], by VertexId
  std::vector<Vec2> in_plane;   // the same in the patch's frame [m]
  Frame frame;
  double snap = 0;  // [m]

 private:
  // A part of a border between neighbouring lattice vertices. The leaves on both sides refer to the same
  // stretch.
  struct Stretch {
    VertexId a, b;                                           // vertices at ascending lattice points
    std::vector<std::pair<double, std::int32_t>> crossings;  // (fraction from a to b, line)
    std::vector<VertexId> inner;                             // vertices between a and b, in order from a
    int uses = 0;  // number of leaves along it; 1 on the patch's outline
  };
  struct StretchUse {
    std::uint32_t stretch;
    bool reversed;
  };
  class Builder;

  VertexId AddBetween(const Stretch& stretch, double fraction);
  void WeldTo(Stretch& stretch, const Vec3& point);

  std::vector<Stretch> stretches_;
  std::vector<std::vector<StretchUse>> uses_;  // per leaf, counter-clockwise
};

}  // namespace penumbra
