// solver/transport/solvers/iteration_report.h

#pragma once

#include <cstddef>
#include <span>

namespace penumbra {

// The work of one iteration of a solver, and the state after the iteration.
struct IterationReport {
  double residual = 0;  // bound of (error of any radiosity) / (largest reflected radiosity)
  double eps = 0;       // the link error above which links were split [W/m^2]
  std::size_t elements = 0, links = 0;
  std::size_t sweeps = 0;  // number of sweeps: gathers over all links, each followed by push-pull
  std::size_t links_split = 0;
  double seconds = 0;
};

// True if another iteration of the solver would change nothing: the last two iterations split no link, and
// the residual hardly fell.
bool IsStuck(std::span<const IterationReport> reports);

}  // namespace penumbra
