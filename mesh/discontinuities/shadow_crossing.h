// mesh/discontinuities/shadow_crossing.h
//
// Adaptive discontinuity meshing (Stuerzlinger 1994): the exact shadow boundaries of a source are wanted only
// in elements that one of them crosses, and that is seen from what the element's corners see of the source.

#pragma once

#include <cstdint>
#include <unordered_map>

#include "mesh/discontinuities/discontinuity.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Answers for the leaves of one receiver, and remembers.
class ShadowCrossing {
 public:
  // All must outlive the object; the forest may not change.
  ShadowCrossing(const ElementForest& forest, const PatchVisibility& visibility, PatchId receiver);

  // True if not all of the leaf's corners, and its centre, see the same ones of the source's corners and
  // centre. Shadows that slip between these points are missed, as in the paper.
  bool Crosses(PatchId source, ElementId leaf);

 private:
  std::uint32_t SeenFrom(const Vec3& x, PatchId source) const;

  const ElementForest& forest_;
  const PatchVisibility& visibility_;
  PatchId receiver_;
  std::unordered_map<std::uint64_t, bool> known_;
};

}  // namespace penumbra
