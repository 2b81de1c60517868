// mesh/interpolants/row_sampler.h
//
// Computes the form factors of mesh nodes (vertices and edge midpoints) to all light sources: one row for
// each node. For any radiosities of the sources, the product of a node's row with the radiosities is the
// irradiance at the node.

#pragma once

#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_sampler.h"
#include "mesh/interpolants/sample_cache.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

class RowSampler {
 public:
  // `exact` computes the rows of form factors, within `tolerance` (PointIrradiance::RecordOnPatch). If `rows`
  // is not null, rows of form factors that the cache `rows` contains are not computed again. The cached rows
  // of form factors must belong to the sources of `exact`. If `keep` is true, new rows of form factors are
  // added to the cache `rows`. The constructor arguments must outlive the RowSampler. REQUIRES:
  // exact.CanRecord() is true, and `rows` is not null if `keep` is true.
  RowSampler(const PointIrradiance& exact, double tolerance, SampleCache* rows, bool keep);

  // Returns the irradiance sample and the row of form factors for each point. At() computes the rows of form
  // factors in parallel, but only one thread may call At().
  std::vector<PointIrradianceResult> At(std::span<const PatchPoint> points) const;

  // Returns a sampler of the irradiance from `light`, a set with the same sources but other radiosities
  // (SourceSet::WithLight). The RowSampler and `light` must outlive the returned sampler, which one thread at
  // a time may use.
  IrradianceSampler For(const SourceSet& light) const;

  const PointIrradiance& exact() const { return exact_; }

 private:
  const PointIrradiance& exact_;
  const double tolerance_;
  SampleCache* const rows_;
  const bool keep_;
};

}  // namespace penumbra
