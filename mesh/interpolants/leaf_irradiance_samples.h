// mesh/interpolants/leaf_irradiance_samples.h
//
// How much light there is in places of a leaf, where its mean does not tell: half of it may lie in shadow.

#pragma once

#include <cstddef>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/sample_cache.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Answers for the leaves of one patch, and remembers. Not for several threads at once.
class LeafIrradianceSamples {
 public:
  // All must outlive the object; the forest may not change.
  LeafIrradianceSamples(const ElementForest& forest, PatchId patch, const IrradianceSampler& sampler);

  // About the irradiance at a place of the leaf, linear between samples at its corners, the middles of its
  // sides and its middle [W/m^2].
  Rgb At(ElementId leaf, const Vec3& place);
  // Calls of the sampler so far.
  std::size_t evaluations() const { return samples_.size(); }

 private:
  Rgb Sample(const Element& leaf, const Vec3& point);

  const ElementForest& forest_;
  const PatchId id_;
  const Patch& patch_;
  const IrradianceSampler& sampler_;
  const double uncertainty_;  // [m]
  SampleCache samples_;
};

}  // namespace penumbra
