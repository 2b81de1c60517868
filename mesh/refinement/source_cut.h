// mesh/refinement/source_cut.h
//
// Chooses how finely leaves are divided into sources, such that the irradiance from the sources is
// sufficiently accurate.

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
  // The 99th percentile of the relative error (RelativeErrors) of the irradiance from the cells of the cut;
  // the true value is the irradiance from the finest cells. Each error is multiplied by
  // PointIrradiance::Reverberation(), because an error of irradiance is amplified by repeated reflection.
  double p99 = 0;
};

// The coarsest cut with p99 <= options.error, measured at random points that are distributed uniformly over
// the reflecting fronts; if there is no such cut, the finest cut. Form factors are computed once for each
// point, for the finest sources; the irradiance from coarser sources is computed from these form factors. If
// cancelled, the result is meaningless.
SourceCut ChooseSourceCut(const RadiositySolution& solution, const SourceCells& cells,
                          const PointIrradiance& exact, const SourceCutOptions& options,
                          const ExecutionContext& context = ExecutionContext());

}  // namespace penumbra
