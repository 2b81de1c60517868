// mesh/interpolants/reference_irradiance.h
//
// Factors that convert absolute errors of irradiance to errors relative to the irradiance of a quadtree leaf
// in the solution.

#pragma once

#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

class ReferenceIrradiance {
 public:
  // The radiosity solution must outlive the ReferenceIrradiance. With DiscontinuityWeight::kThesis, which
  // does not measure errors, all factors of errors are 1.
  ReferenceIrradiance(const RadiositySolution& solution, DiscontinuityWeight weight);

  // The factor by which errors of irradiance on a leaf are multiplied: (mean irradiance of the scene's
  // leaves) / (irradiance of the leaf, bounded from below). ScaleOf() exceeds 1 for dark leaves. `forest`
  // holds the solution's quadtrees or a refinement of them.
  double ScaleOf(const ElementForest& forest, ElementId leaf) const;
  // The factor by which errors of irradiance at a point are multiplied: (mean irradiance of the scene's
  // leaves) / (irradiance `light` at the point [W/m^2], bounded from below). A point may be darker than the
  // mean irradiance of every leaf.
  double ScaleIn(const Rgb& light) const;
  // The maximum of ScaleOf() over the quadtree leaves of the patch.
  double LargestScale(PatchId patch) const;
  // Returns `options` with min_weight so small that DiscontinuityFinder finds all discontinuities that may
  // become edges on the patch, including those that refinement may request later. The darker the patch's
  // darkest leaf, the smaller the minimum weight, because errors are relative to the irradiance.
  DiscontinuityOptions ToFindOn(PatchId patch, DiscontinuityOptions options) const;

 private:
  double Scale(double light, double darkest) const;

  const RadiositySolution& solution_;
  std::vector<double> darkest_;  // irradiance of each patch's darkest leaf, in its brightest channel [W/m^2]
  // The mean irradiance over all leaves [W/m^2]; if it is 0, errors are not weighted.
  double mean_ = 0;
};

}  // namespace penumbra
