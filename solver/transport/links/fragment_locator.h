// solver/transport/links/fragment_locator.h
//
// Finds the fragment, a convex piece of a leaf with its own radiosity, at a point.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

class FragmentLocator {
 public:
  // Later changes of `solution` do not change the FragmentLocator.
  explicit FragmentLocator(const RadiositySolution& solution);

  // The index in RadiositySolution::fragments of the leaf's fragment that contains the point, or of the
  // nearest fragment if the point lies outside because of rounding; -1 if the leaf is not cut into fragments.
  std::int32_t At(ElementId leaf, const Vec3& point) const {
    return first_.empty() || IsWhole(leaf) ? -1 : Find(leaf, point);
  }
  // The fragments of a leaf have the indices FirstOf(leaf) to FirstOf(leaf + 1) - 1.
  std::int32_t FirstOf(ElementId leaf) const {
    return first_.empty() ? 0 : first_[static_cast<std::size_t>(leaf)];
  }
  bool IsWhole(ElementId leaf) const { return FirstOf(leaf) == FirstOf(leaf + 1); }

 private:
  // An edge of a fragment: the signed distance of a point p from the edge is dot(inward, p) - offset [m],
  // which is positive inside. `inward` is a unit vector.
  struct Edge {
    Vec3 inward = Vec3::Zero();
    double offset = 0;
  };

  std::int32_t Find(ElementId leaf, const Vec3& point) const;

  // Index of each element's first fragment; last entry: number of fragments. first_ is empty if no leaf is
  // cut.
  std::vector<std::int32_t> first_;
  std::vector<std::uint32_t> first_edge_;  // index of each fragment's first edge; last entry: number of edges
  std::vector<Edge> edges_;
};

}  // namespace penumbra
