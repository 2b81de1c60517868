// mesh/refinement/source_cut.h
//
// How fine the sources must be for the light that they send to be right.

#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/refinement/source_cells.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct SourceCutOptions {
  double finest = 0;       // the smallest score that is tried
  double error = 0;        // the largest 99th percentile of the relative error that will do
  std::size_t points = 0;  // at which the error is measured
  std::uint64_t seed = 0;  // of these points
};

struct SourceCut {
  double score = 0;  // of SourceCells::Cut()
  // The 99th percentile of the relative error that sources of these cells make, against all that the trees
  // have (RelativeErrors), each as often as it comes back (PointIrradiance::Reverberation).
  double p99 = 0;
};

// The coarsest cut by score whose p99 is at most the error asked for, at random points that spread evenly
// over the fronts; the finest there is if none is good enough. Every point is looked at once, with the finest
// sources: what coarser ones would make of it follows from the same form factors. Of no use if it was
// cancelled.
SourceCut ChooseSourceCut(const RadiositySolution& solution, const SourceCells& cells,
                          const PointIrradiance& exact, const SourceCutOptions& options,
                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
