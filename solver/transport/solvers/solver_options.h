// solver/transport/solvers/solver_options.h
//
// Options of the solvers.

#pragma once

#include <cstddef>
#include <string>

#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/settling.h"

namespace penumbra {

// Options of the hierarchical solver.
struct SolverOptions {
  double eps = 0.1;        // largest transport error of a link [W/m^2] (thesis, Appendix A, 1)
  double min_area = 1e-5;  // smallest area of an element [m^2] (Appendix A, 2)
  // Converged when the distance of every radiosity from its limit, relative to the largest reflected
  // radiosity, is at most this (Appendix A, 7).
  double relative_cutoff = 1e-4;
  int max_iterations = 100;  // each gathers until the light settles, then refines
  // Refinement stops before the number of links exceeds that between the roots by more than this: about 800
  // MB.
  std::size_t max_links = 8'000'000;
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";  // a name in RefinementOracles()
  // Starts with a larger eps, and lowers it from iteration to iteration (Hanrahan, Salzman and Aupperle
  // 1991).
  bool multigrid = false;
  std::string form_factors = "cubature";  // a name in LinkFormFactorMethods()
  int max_corrections = 2;  // passes of exact irradiance over the leaves; 0: links only, as in the thesis
  // Another stage makes the last of these passes, through LightSolver::SetLight().
  bool last_correction_elsewhere = false;
  // Tolerance of the samples of corrections (PointIrradiance::NearlyOnPatch); 0: exact.
  double correction_tolerance = 0;
  // About the largest relative error of irradiance that constant radiosity may cause at receivers.
  // Corrections cut leaves into as many parts as this requires (LeafCells), after some passes with fewer
  // parts. 0: only contacts cut leaves.
  double source_error = 0;
};

// Options of all solvers; each solver uses its own part.
struct LightSolverOptions {
  SolverOptions hierarchical;
  DenseOptions dense;
};

}  // namespace penumbra
