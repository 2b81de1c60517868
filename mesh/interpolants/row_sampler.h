// mesh/interpolants/row_sampler.h
//
// Rows of form factors at the nodes of a mesh. A row gives the irradiance of a node for any light of the same
// sources as a product.

#pragma once

#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_sampler.h"
#include "mesh/interpolants/sample_cache.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class RowSampler {
 public:
  // `exact` gives the rows, within `tolerance` (PointIrradiance::RecordOnPatch). If `rows` is not null, rows
  // that it holds are taken from there; they must refer to the sources of `exact`. If `keep` is true, new
  // rows are added to it. The arguments must outlive the object. REQUIRES: exact.CanRecord(); `rows` is not
  // null if `keep`.
  RowSampler(const PointIrradiance& exact, double tolerance, SampleCache* rows, bool keep);

  // A sample with its row for each point. The rows are found in parallel, and only one thread may call.
  std::vector<PointIrradianceResult> At(std::span<const PatchPoint> points) const;

  // The irradiance by the light of another set with the same nodes (SourceSet::WithLight). The row sampler
  // and `light` must outlive the result, which one thread may use at a time.
  IrradianceSampler For(const SourceSet& light) const;

  const PointIrradiance& exact() const { return exact_; }

 private:
  const PointIrradiance& exact_;
  const double tolerance_;
  SampleCache* const rows_;
  const bool keep_;
};

}  // namespace penumbra
