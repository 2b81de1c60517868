// mesh/interpolants/reference_irradiance.h
//
// Errors of what is shown are relative: on a leaf they count beside the light that the solution gives it.

#pragma once

#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"

namespace penumbra {

class ReferenceIrradiance {
 public:
  // The solution must outlive it. The thesis's weight does not tell of errors: it counts alike everywhere.
  ReferenceIrradiance(const RadiositySolution& solution, DiscontinuityWeight weight);

  // How many times an error counts on a leaf of the forest, which was grown from the solution's: once at the
  // mean irradiance, more often in the dark.
  double ScaleOf(const ElementForest& forest, ElementId leaf) const;
  // The same where there is this irradiance [W/m^2], which may be darker than the mean of any leaf.
  double ScaleIn(const Rgb& light) const;
  // The largest on the patch, of its leaves.
  double LargestScale(PatchId patch) const;
  // The options to find all that may become an edge by the light of the patch's leaves, if only because
  // refinement asks for it.
  DiscontinuityOptions ToFindOn(PatchId patch, DiscontinuityOptions options) const;

 private:
  double Scale(double light, double darkest) const;

  const RadiositySolution& solution_;
  std::vector<double> darkest_;  // leaf of each patch, by its brightest channel [W/m^2]
  double mean_ = 0;              // over the leaves; 0: all count once [W/m^2]
};

}  // namespace penumbra
