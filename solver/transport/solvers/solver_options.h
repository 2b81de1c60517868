// solver/transport/solvers/solver_options.h
//
// What the solvers can be told.

#pragma once

#include <cstddef>
#include <string>

#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/settling.h"

namespace penumbra {

// Of the hierarchical solver.
struct SolverOptions {
  double eps = 0.1;        // largest transport error of a link [W/m^2] (thesis, Appendix A, 1)
  double min_area = 1e-5;  // smallest area of an element [m^2] (Appendix A, 2)
  // Converged when no radiosity is farther off, relative to the largest reflected one (Appendix A, 7).
  double relative_cutoff = 1e-4;
  int max_iterations = 100;  // each gathers until it settles, then refines
  // Refinement ends before there are so many more links than between roots: some 800 MB.
  std::size_t max_links = 8'000'000;
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";  // its name in RefinementOracles()
  // Refine by a larger eps first, lowered from one iteration to the next (Hanrahan, Salzman and Aupperle
  // 1991).
  bool multigrid = false;
  std::string form_factors = "cubature";  // its name in LinkFormFactorMethods()
  int max_corrections = 2;  // passes of exact irradiance over the leaves; 0: links alone, as in the thesis
  // Another stage makes the last of these passes, by LightSolver::SetLight().
  bool last_correction_elsewhere = false;
  // What the points of corrections may leave out of their sources' detail (PointIrradiance::NearlyOnPatch);
  // 0: nothing.
  double correction_tolerance = 0;
  // About the largest relative error, where light arrives, that constant radiosity may cause: corrections cut
  // leaves into as many parts as that takes (LeafCells), after some passes with fewer. 0: only where contacts
  // cut them.
  double source_error = 0;
};

// Of all solvers; each looks at its own part.
struct LightSolverOptions {
  SolverOptions hierarchical;
  DenseOptions dense;
};

}  // namespace penumbra
