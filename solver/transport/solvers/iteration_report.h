// solver/transport/solvers/iteration_report.h

#pragma once

#include <cstddef>
#include <span>

namespace penumbra {

// The work of one iteration of a solver, and the state after the iteration.
struct IterationReport {
  double residual = 0;  // bound of the error of any radiosity, relative to the largest reflected one
  double eps = 0;       // for which links were judged [W/m^2]
  std::size_t elements = 0, links = 0;
  std::size_t sweeps = 0;  // gathers over all links, with push-pull
  std::size_t links_split = 0;
  double seconds = 0;
};

// True if another iteration would change nothing: the last two iterations split no link, and the residual
// hardly fell.
bool IsStuck(std::span<const IterationReport> reports);

}  // namespace penumbra
