// solver/transport/links/element_locator.h
//
// Finds the leaf at a point of a patch, for many points: a table that is smaller and faster than
// ElementForest::LeafAt().

#pragma once

#include <vector>

#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

class ElementLocator {
 public:
  // The object does not change with the forest.
  explicit ElementLocator(const ElementForest& forest);

  // A place in an element, by coordinates (s, t) from 0 to 1. Corner 0 of an element is at (0, 0), and corner
  // 1 at (1, 0). The last corner is at (0, 1); a quadrilateral also has a corner at (1, 1).
  struct Place {
    ElementId element = kNoElement;
    double s = 0, t = 0;
  };

  // The leaf of the patch that contains the point, or one of the nearest leaves if the point lies outside
  // because of rounding.
  ElementId LeafAt(PatchId patch, const Vec3& point) const {
    return first_child_[static_cast<std::size_t>(patch)] == kNoElement ? ElementForest::Root(patch)
                                                                       : Find(patch, point).element;
  }
  // The point's place in that leaf.
  Place Find(PatchId patch, const Vec3& point) const;

 private:
  // (s, t) of a point p on a patch: s = s_of . (p - origin), t = t_of . (p - origin). A quadrilateral that is
  // no parallelogram is bilinear: p = origin + s a + t b + s t twist.
  struct Coordinates {
    Vec3 origin, s_of, t_of, twist;
    bool is_triangle = false, is_bilinear = false;
  };

  std::vector<Coordinates> patch_;
  std::vector<ElementId> first_child_;  // of each element
};

}  // namespace penumbra
