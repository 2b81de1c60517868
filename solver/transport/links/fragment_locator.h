// solver/transport/links/fragment_locator.h
//
// Finds the fragment at a point of a leaf, for many points.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

class FragmentLocator {
 public:
  // The object does not change with the solution.
  explicit FragmentLocator(const RadiositySolution& solution);

  // The index in RadiositySolution::fragments of the leaf's fragment that contains the point, or of the
  // nearest one if the point lies outside because of rounding; -1 if the leaf is whole.
  std::int32_t At(ElementId leaf, const Vec3& point) const {
    return first_.empty() || IsWhole(leaf) ? -1 : Find(leaf, point);
  }
  // The fragments of the leaf are those from FirstOf(leaf) to FirstOf(leaf + 1) - 1.
  std::int32_t FirstOf(ElementId leaf) const {
    return first_.empty() ? 0 : first_[static_cast<std::size_t>(leaf)];
  }
  bool IsWhole(ElementId leaf) const { return FirstOf(leaf) == FirstOf(leaf + 1); }

 private:
  // The line of an edge, in the polygon's plane: inward . p - offset is the distance of p from the edge [m].
  struct Edge {
    Vec3 inward = Vec3::Zero();  // unit
    double offset = 0;           // [m]
  };

  std::int32_t Find(ElementId leaf, const Vec3& point) const;

  std::vector<std::int32_t> first_;  // of each element, and the number of fragments; empty without fragments
  std::vector<std::uint32_t> first_edge_;  // of each fragment, and the number of edges
  std::vector<Edge> edges_;
};

}  // namespace penumbra
