// mesh/triangulation/patch_borders.h
//
// The vertices on the borders of a patch's leaves: the corners of leaves (hanging ones as well) and, on each
// stretch between two of these, the crossings with the lines that are active in either leaf. Each has one
// position, whoever asks (thesis 3.6, cases A and B).

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
  // REQUIRES: the quadtree is balanced, and has not changed since `dsets` were made.
  PatchBorders(const ElementForest& forest, PatchId patch, const PatchDSets& dsets);

  // The vertices around a leaf, by its number in PatchDSets::leaves, counter-clockwise.
  void Around(std::size_t leaf, std::vector<VertexId>& loop) const;

  // The positions of the vertices on the patch's outline [m].
  std::vector<Vec3> OutlineVertices() const;
  // Makes the points vertices of the outline where they lie on it: a vertex within the snap distance of one
  // takes its position. Others are left alone.
  void Weld(std::span<const Vec3> points);

  std::vector<Vec3> positions;  // [m], by VertexId
  std::vector<Vec2> in_plane;   // the same in the patch's frame [m]
  Frame frame;
  double snap = 0;  // [m]

 private:
  // A stretch of leaves' borders between neighbouring lattice vertices. Leaves on both sides refer to it.
  struct Stretch {
    VertexId a, b;                                           // ascending lattice points
    std::vector<std::pair<double, std::int32_t>> crossings;  // (fraction from a to b, line)
    std::vector<VertexId> inner;                             // vertices between a and b, from a
    int uses = 0;                                            // leaves beside it: one on the outline
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
