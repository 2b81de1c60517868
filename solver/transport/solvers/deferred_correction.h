// solver/transport/solvers/deferred_correction.h

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// Deferred correction (Stetter 1978): the difference between the exact irradiance of an element and the
// irradiance that the hierarchical links bring. DeferredCorrection holds all data of the deferred correction,
// so that a cancelled step of the solver can restore these data.
struct DeferredCorrection {
  // for each leaf: (exact irradiance) - (irradiance from the links) [W/m^2]; empty before the first pass of
  // deferred correction
  std::vector<Rgb> of_element;
  // for each fragment of a leaf: (exact irradiance of the fragment) - (irradiance of the leaf) [W/m^2]
  std::vector<Rgb> of_fragment;
  // For each leaf, in ascending order of ElementId: the parts into which CutLeaf() has cut the leaf. The list
  // of parts is empty until leaves are cut for the first time.
  std::vector<std::vector<Polygon3>> parts_of_leaf;

  // Adds (exact irradiance - solution.irradiance) to the correction of each leaf; `exact` is indexed by
  // ElementId [W/m^2].
  void AddDifference(const RadiositySolution& solution, std::span<const Rgb> exact);
  // Sets the irradiance of each fragment (part of a leaf) to (irradiance of the leaf) + (correction
  // of_fragment), and updates the fragment's radiosity.
  void LightFragments(RadiositySolution& solution) const;
};

}  // namespace penumbra
