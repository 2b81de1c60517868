// solver/transport/solvers/iteration_report.h

#pragma once

#include <cstddef>
#include <span>

namespace penumbra {

// What one round of a solver did, and what it left.
struct IterationReport {
  double residual = 0;  // bound of what is missing from any radiosity, relative to the largest reflected one
  double eps = 0;       // by which links were judged [W/m^2]
  std::size_t elements = 0, links = 0;
  std::size_t sweeps = 0;  // gathers with push-pull
  std::size_t links_split = 0;
  double seconds = 0;
};

// Whether another iteration would change nothing: the last ones split no link and brought the light no
// nearer.
bool IsStuck(std::span<const IterationReport> reports);

}  // namespace penumbra
