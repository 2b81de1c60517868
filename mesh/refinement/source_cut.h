// mesh/refinement/source_cut.h
//
// The resolution of sources that makes the light they send sufficiently accurate.

#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/refinement/source_cells.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct SourceCutOptions {
  double finest = 0;       // smallest score that is tried
  double error = 0;        // largest acceptable 99th percentile of the relative error
  std::size_t points = 0;  // number of points that measure the error
  std::uint64_t seed = 0;  // seed of these points
};

struct SourceCut {
  double score = 0;  // argument of SourceCells::Cut()
  // The 99th percentile of the relative error of the cut's cells as sources, compared with the finest cells
  // (RelativeErrors). Each error is multiplied by PointIrradiance::Reverberation, which accounts for its
  // repeated return.
  double p99 = 0;
};

// The coarsest cut by score whose p99 is at most options.error, at random points that are distributed
// uniformly over the reflecting fronts; if no cut is good enough, the finest cut. The function evaluates
// every point once, with the finest sources, and computes the irradiance from coarser sources from the same
// form factors. If cancelled, the result is meaningless.
SourceCut ChooseSourceCut(const RadiositySolution& solution, const SourceCells& cells,
                          const PointIrradiance& exact, const SourceCutOptions& options,
                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
