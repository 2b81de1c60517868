// mesh/interpolants/leaf_irradiance_samples.h
//
// Approximate irradiance at points of a leaf, where the leaf's mean is not enough: half of a leaf may lie in
// shadow.

#pragma once

#include <cstddef>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/sample_cache.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Answers for the leaves of one patch, and stores the samples. Not safe from several threads at once.
class LeafIrradianceSamples {
 public:
  // All arguments must outlive the object; the forest must not change.
  LeafIrradianceSamples(const ElementForest& forest, PatchId patch, const IrradianceSampler& sampler);

  // The approximate irradiance at a point of the leaf [W/m^2]: linear between samples at the leaf's corners,
  // at the midpoints of its sides and at its centre.
  Rgb At(ElementId leaf, const Vec3& place);
  // Calls of the sampler since construction.
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
