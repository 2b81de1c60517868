// solver/transport/solvers/deferred_correction.h

#pragma once

#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/geometry/vec.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

// What exact irradiance adds to that of the links (Stetter 1978). One value: a step that is cancelled puts
// back the whole of it.
struct DeferredCorrection {
  std::vector<Rgb> of_element;   // of leaves: exact less linked irradiance [W/m^2]; empty: none
  std::vector<Rgb> of_fragment;  // per fragment of the solution: exact irradiance less its leaf's [W/m^2]
  // Per leaf in ascending order: the parts that LeafCells cut it into; empty until they were cut.
  std::vector<std::vector<Polygon3>> parts_of_leaf;

  // Adds what sets `exact`, by element, apart from the irradiance that the solution's leaves have.
  void AddDifference(const RadiositySolution& solution, std::span<const Rgb> exact);
  // Lights the solution's fragments: each has the irradiance of its leaf and what sets it apart from that.
  void LightFragments(RadiositySolution& solution) const;
};

}  // namespace penumbra
