// solver/transport/points/leaf_irradiance.h
//
// The exact mean irradiance of leaves (undivided quadtree elements). Deferred correction moves a solution
// towards the exact mean irradiance. Reports measure the error of a solution as the difference from the exact
// mean irradiance.

#pragma once

#include <cstdint>
#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafIrradiance {
  Rgb mean = Rgb::Zero();  // mean irradiance of the leaf [W/m^2]
  // mean irradiance of each fragment (convex part) of the leaf, if the leaf is cut [W/m^2]
  std::vector<Rgb> fragments;
};

enum class LeafSampling : std::uint8_t {
  kCentroid,  // one sample point for the leaf, or for each fragment of a cut leaf
  kCubature,  // a cubature rule of degree 2 or 3, refined where the irradiances at its points differ
};

// The mean irradiance of a leaf and of its fragments (convex parts of a cut leaf), from samples at points. If
// `tolerance` is positive, the samples are computed by PointIrradiance::NearlyOnPatch() with this tolerance.
LeafIrradiance ExactLeafIrradiance(const RadiositySolution& solution, const PointIrradiance& irradiance,
                                   ElementId leaf, LeafSampling sampling, double tolerance = 0);

}  // namespace penumbra
