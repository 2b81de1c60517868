// mesh/discontinuities/shadow_crossing.h
//
// Adaptive discontinuity meshing (Stuerzlinger 1994) inserts the exact shadow boundaries of a source only in
// elements that a boundary crosses. Visibility of the source from the element's corners tells which elements
// these are.

#pragma once

#include <cstdint>
#include <unordered_map>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Tests the leaves of one receiver, and stores the results.
class ShadowCrossing {
 public:
  // All arguments must outlive the object; the forest must not change.
  ShadowCrossing(const ElementForest& forest, const PatchVisibility& visibility, PatchId receiver);

  // True unless the leaf's corners and centre all see the same of the source's corners and centre. The test
  // misses shadows that lie between these points, as in the paper.
  bool Crosses(PatchId source, ElementId leaf);

 private:
  std::uint32_t SeenFrom(const Vec3& x, PatchId source) const;

  const ElementForest& forest_;
  const PatchVisibility& visibility_;
  PatchId receiver_;
  std::unordered_map<std::uint64_t, bool> known_;
};

}  // namespace penumbra
