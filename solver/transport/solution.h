// solver/transport/solution.h
//
// What the hierarchical solver leaves behind (thesis, chapter 4): quadtrees, links with their blockers, and the light
// on every element.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/element_forest.h"
#include "solver/visibility/patch_visibility.h"

namespace penumbra {

// The transport from one element to another, at one level of each.
struct Link {
  ElementId receiver = kNoElement, source = kNoElement;
  double form_factor = 0;      // F(receiver <- source): irradiance on the receiver per unit radiosity of the source
  double variation = 0;        // the spread of the point form factors over the receiver, the root mean square
  Visibility visibility = Visibility::kVisible;
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

struct RadiositySolution {
  ElementForest forest;
  // Per element [W/m^2]; a parent's is the area-weighted mean of its children's.
  std::vector<Rgb> irradiance, radiosity;
};

}  // namespace penumbra
