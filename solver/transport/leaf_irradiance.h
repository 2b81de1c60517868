// solver/transport/leaf_irradiance.h
//
// The exact mean irradiance of leaves: what deferred correction adds, and what tells how far a solution is
// off.

#pragma once

#include <vector>

#include "solver/transport/point_irradiance.h"
#include "solver/transport/solution.h"

namespace penumbra {

struct LeafIrradiance {
  Rgb mean = Rgb::Zero();      // [W/m^2]
  std::vector<Rgb> fragments;  // of each of the leaf's fragments, if it has any [W/m^2]
};

// By cubature over the leaf, or over each of its fragments.
LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf);

}  // namespace penumbra
