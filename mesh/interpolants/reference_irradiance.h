// mesh/interpolants/reference_irradiance.h
//
// Factors that convert absolute errors of irradiance to errors relative to the irradiance of a leaf in the
// solution.

#pragma once

#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

class ReferenceIrradiance {
 public:
  // The solution must outlive the object. With the thesis's weight, which does not measure errors, all
  // factors are 1.
  ReferenceIrradiance(const RadiositySolution& solution, DiscontinuityWeight weight);

  // The factor for errors on a leaf: (mean irradiance of the scene's leaves) / (irradiance of the leaf,
  // bounded from below); it exceeds 1 for dark leaves. `forest` is the solution's forest or a refinement of
  // it.
  double ScaleOf(const ElementForest& forest, ElementId leaf) const;
  // The factor for errors at a point with irradiance `light` [W/m^2], which may be less than the mean
  // irradiance of every leaf.
  double ScaleIn(const Rgb& light) const;
  // The maximum of ScaleOf() over the leaves of the patch.
  double LargestScale(PatchId patch) const;
  // Returns `options` with min_weight so small that DiscontinuityFinder finds all discontinuities that may
  // become edges on the patch, including those that refinement may request. The minimum weight depends on the
  // irradiance of the patch's leaves.
  DiscontinuityOptions ToFindOn(PatchId patch, DiscontinuityOptions options) const;

 private:
  double Scale(double light, double darkest) const;

  const RadiositySolution& solution_;
  std::vector<double> darkest_;  // darkest leaf of each patch, by its brightest channel [W/m^2]
  double mean_ = 0;              // over the leaves [W/m^2]; 0: all factors are 1
};

}  // namespace penumbra
