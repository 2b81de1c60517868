// mesh/discontinuities/shadow_crossing.h
//
// Adaptive discontinuity meshing (Stuerzlinger 1994) inserts the exact shadow boundaries of a source only in
// elements that a boundary crosses. A shadow boundary is assumed to cross an element if different parts of
// the light source are visible from the element's corners.

#pragma once

#include <cstdint>
#include <unordered_map>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Tests whether shadow boundaries cross the quadtree leaves of one receiver, and caches the results.
class ShadowCrossing {
 public:
  // All constructor arguments must outlive the ShadowCrossing, and the forest of quadtrees must not change.
  ShadowCrossing(const ElementForest& forest, const PatchVisibility& visibility, PatchId receiver);

  // Tests which of the source's corners and centre are visible from the leaf's corners and centre. Returns
  // false if the same points of the light source are visible from all points of the leaf that are tested. As
  // in the paper, the visibility test misses shadows that lie between the tested points.
  bool Crosses(PatchId source, ElementId leaf);

 private:
  std::uint32_t SeenFrom(const Vec3& x, PatchId source) const;

  const ElementForest& forest_;
  const PatchVisibility& visibility_;
  PatchId receiver_;
  std::unordered_map<std::uint64_t, bool> known_;
};

}  // namespace penumbra
