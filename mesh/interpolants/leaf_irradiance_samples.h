// mesh/interpolants/leaf_irradiance_samples.h
//
// Approximate irradiance at points of a quadtree leaf. Approximate irradiance is used where the mean
// irradiance of a leaf is not accurate enough, for example because half of the leaf lies in shadow.

#pragma once

#include <cstddef>
#include <utility>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/sample_cache.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// Computes approximate irradiance on the quadtree leaves of one patch, and caches the samples. A
// LeafIrradianceSamples must not be used by several threads at once.
class LeafIrradianceSamples {
 public:
  // `known`, unless null, holds samples of the same sampler that are used instead of new samples. All
  // constructor arguments must outlive the LeafIrradianceSamples. The forest of quadtrees and `known` must
  // not change.
  LeafIrradianceSamples(const ElementForest& forest, PatchId patch, const IrradianceSampler& sampler,
                        const SampleCache* known = nullptr);

  // Returns the approximate irradiance at a point of the leaf [W/m^2]: linear interpolation between samples
  // at the leaf's corners, at the midpoints of its sides and at its centre.
  Rgb At(ElementId leaf, const Vec3& place);
  // The number of calls of the sampler since construction.
  std::size_t evaluations() const { return samples_.size(); }
  // All samples that the sampler has computed since construction.
  SampleCache TakeSamples() && { return std::move(samples_); }

 private:
  Rgb Sample(const Element& leaf, const Vec3& point);

  const ElementForest& forest_;
  const PatchId id_;
  const Patch& patch_;
  const IrradianceSampler& sampler_;
  const double uncertainty_;  // the uncertainty of the positions of irradiance samples, from rounding [m]
  const SampleCache* known_;
  SampleCache samples_;
};

}  // namespace penumbra
