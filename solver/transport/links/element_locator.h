// solver/transport/links/element_locator.h
//
// Finds the leaf of a quadtree at a point of a patch, for many points, with a table that takes less memory
// and less time than ElementForest::LeafAt().

#pragma once

#include <vector>

#include "solver/geometry/vec.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

class ElementLocator {
 public:
  // The ElementLocator copies the quadtrees; later changes of `forest` do not change the ElementLocator.
  explicit ElementLocator(const ElementForest& forest);

  // A place in an element, given by coordinates (s, t) from 0 to 1. Corner 0 of an element has (s, t) = (0,
  // 0), and corner 1 has (1, 0). The last corner of an element has (s, t) = (0, 1); corner 2 of a
  // quadrilateral has (1, 1).
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
  // The leaf of the patch that contains the point, and the point's coordinates (s, t) in the leaf.
  Place Find(PatchId patch, const Vec3& point) const;

 private:
  // The data from which the coordinates (s, t) of a point p on a patch are computed: s = dot(s_of, p -
  // origin), t = dot(t_of, p - origin). On a quadrilateral that is no parallelogram, positions are bilinear:
  // p = origin + s a + t b + s t twist.
  struct Coordinates {
    Vec3 origin, s_of, t_of, twist;
    bool is_triangle = false, is_bilinear = false;
  };

  std::vector<Coordinates> patch_;
  std::vector<ElementId> first_child_;  // id of the first child of each element; kNoElement for a leaf
};

}  // namespace penumbra
