// solver/transport/points/leaf_irradiance.h
//
// The exact mean irradiance of leaves: what deferred correction adds, and what tells how far a solution is
// off.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafIrradiance {
  Rgb mean = Rgb::Zero();      // [W/m^2]
  std::vector<Rgb> fragments;  // of each of the leaf's fragments, if it has any [W/m^2]
};

enum class LeafSampling : std::uint8_t {
  kCentroid,  // one point for the leaf or each fragment
  kCubature,  // a rule of degree 2 or 3, refined where its points disagree
};

// The means of irradiance at points; with a tolerance, which these may leave out of their sources' detail, by
// PointIrradiance::NearlyOnPatch().
LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf, LeafSampling sampling, double tolerance = 0);

}  // namespace penumbra
