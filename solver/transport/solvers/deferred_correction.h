// solver/transport/solvers/deferred_correction.h

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// The difference between exact irradiance and the irradiance of the links (Stetter 1978). The struct holds
// all data of the correction, so that a cancelled step can restore them.
struct DeferredCorrection {
  std::vector<Rgb> of_element;   // of leaves: exact irradiance - irradiance of the links [W/m^2]; empty: none
  std::vector<Rgb> of_fragment;  // of the solution's fragments: exact irradiance - that of the leaf [W/m^2]
  // For each leaf in ascending order: the parts into which LeafCells has cut it. The list is empty before
  // leaves have been cut for the first time.
  std::vector<std::vector<Polygon3>> parts_of_leaf;

  // Adds exact - solution.irradiance to the correction of each leaf; `exact` is indexed by ElementId.
  void AddDifference(const RadiositySolution& solution, std::span<const Rgb> exact);
  // Sets the irradiance of each fragment of the solution to (irradiance of the leaf) + of_fragment, and
  // updates the fragment's radiosity.
  void LightFragments(RadiositySolution& solution) const;
};

}  // namespace penumbra
