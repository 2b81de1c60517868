// mesh/triangulation/patch_borders.h
//
// The vertices on the borders of a patch's leaves: the corners of leaves, including hanging corners; and, on
// each stretch between two corners, the crossings with the lines that are active in one of the two adjacent
// leaves. Both adjacent leaves use the same position of a vertex (thesis 3.6, cases A and B).

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
  // Adds those points that lie on the patch's outline as vertices of the outline. If a vertex of the outline
  // lies within the snap distance of an added point, the vertex moves to this point. Other vertices of the
  // outline remain unchanged.
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
