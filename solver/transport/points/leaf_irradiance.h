// solver/transport/points/leaf_irradiance.h
//
// The exact mean irradiance of leaves: the target of deferred correction, and a measure of a solution's
// error.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafIrradiance {
  Rgb mean = Rgb::Zero();      // [W/m^2]
  std::vector<Rgb> fragments;  // mean of each of the leaf's fragments, if any [W/m^2]
};

enum class LeafSampling : std::uint8_t {
  kCentroid,  // one point for the leaf, or for each fragment
  kCubature,  // a rule of degree 2 or 3, refined where its points disagree
};

// The mean irradiance of a leaf and its fragments, from samples at points. If the tolerance is positive, the
// samples are computed by PointIrradiance::NearlyOnPatch().
LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf, LeafSampling sampling, double tolerance = 0);

}  // namespace penumbra
