// mesh/interpolants/reference_irradiance.h
//
// Factors that make errors of the shown irradiance relative to the irradiance that the solution has on a
// leaf.

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

  // The factor of errors on a leaf of the forest, which must be the solution's forest or grown from it: (mean
  // irradiance over the scene's leaves) / (irradiance of the leaf, bounded from below), so that dark leaves
  // have factors above 1.
  double ScaleOf(const ElementForest& forest, ElementId leaf) const;
  // The factor for errors at a point with irradiance `light` [W/m^2], which may be darker than any leaf's
  // mean.
  double ScaleIn(const Rgb& light) const;
  // The largest factor over the leaves of the patch.
  double LargestScale(PatchId patch) const;
  // The options with a minimum weight that finds all discontinuities that may become edges on the patch,
  // given the irradiance of its leaves, even if only because refinement requests them.
  DiscontinuityOptions ToFindOn(PatchId patch, DiscontinuityOptions options) const;

 private:
  double Scale(double light, double darkest) const;

  const RadiositySolution& solution_;
  std::vector<double> darkest_;  // darkest leaf of each patch, by its brightest channel [W/m^2]
  double mean_ = 0;              // over the leaves [W/m^2]; 0: all factors are 1
};

}  // namespace penumbra
