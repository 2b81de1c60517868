// solver/transport/solvers/solver_options.h
//
// Options of the solvers.

#pragma once

#include <cstddef>
#include <string>

#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/settling.h"

namespace penumbra {

// Options of the hierarchical solver.
struct SolverOptions {
  double eps = 0.1;        // largest transport error of a link [W/m^2] (thesis, Appendix A, 1)
  double min_area = 1e-5;  // smallest area of an element [m^2] (Appendix A, 2)
  // The light has converged if |radiosity - limit| / (largest reflected radiosity) is at most relative_cutoff
  // for every element (Appendix A, 7).
  double relative_cutoff = 1e-4;
  int max_iterations = 100;  // each gathers until the light settles, then refines
  // Refinement stops before (number of links) - (number of links between the roots) exceeds max_links. The
  // default limits the memory of links to about 800 MB.
  std::size_t max_links = 8'000'000;
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";  // a name in RefinementOracles()
  // If true, the first iteration uses a larger eps, and each iteration lowers eps (Hanrahan, Salzman and
  // Aupperle 1991).
  bool multigrid = false;
  std::string form_factors = "cubature";  // a name in LinkFormFactorMethods()
  LinkFormFactorOptions form_factor_options;
  int max_corrections = 2;  // passes of exact irradiance over the leaves; 0: links only, as in the thesis
  // If true, another stage makes the last pass of correction, through LightSolver::SetLight().
  bool last_correction_elsewhere = false;
  // The tolerance of the irradiance samples of corrections (PointIrradiance::NearlyOnPatch); 0 makes the
  // samples exact.
  double correction_tolerance = 0;
  // The approximate limit of the relative error of irradiance at receivers that is caused by treating
  // radiosity as constant over parts of leaves. Corrections cut leaves into as many parts as source_error
  // requires (LeafCells), after some passes with fewer parts. With 0, leaves are cut only at contacts.
  double source_error = 0;
};

// Options of the sampled solver.
struct SampledOptions {
  std::size_t elements = 20'000;  // no element is larger than (area of all fronts) / elements
  // Elements are divided until the relative deviation of direct light within them is at most relative_spread.
  double relative_spread = 0.25;
  std::size_t max_elements = 8'000'000;
  std::size_t element_rays = 64;  // of an element in the last pass
  std::size_t point_rays = 192;   // RadiositySolution::rays_per_point
  int passes = 2;                 // each finer than the one before
  double relative_cutoff = 1e-4;  // as SolverOptions::relative_cutoff
};

// Options of the classic solvers on uniform meshes (UniformSolver).
struct UniformOptions {
  int divisions = 4;                      // elements along each side of a patch (UniformForest)
  std::string form_factors = "cubature";  // a name in LinkFormFactorMethods()
  // Form factors need no variations here. `rays` and `seed` also hold for solvers that cast rays themselves.
  LinkFormFactorOptions form_factor_options;
  IterationScheme scheme = IterationScheme::kJacobi;
  // The light has converged if the residual, as each solver defines it, is at most relative_cutoff.
  double relative_cutoff = 1e-4;
  std::size_t shots = 0;   // the largest number of steps; 0: the solver's
  bool overshoot = false;  // shots anticipate what the shooter will reflect (Shao and Badler 1993)
  // If true, solution() contains an estimate of the light that is still to come. The method works without it.
  bool ambient = false;
};

// The options of all solvers; each solver uses only the member that is named after it, and those on uniform
// meshes use `uniform`.
struct LightSolverOptions {
  SolverOptions hierarchical;
  DenseOptions dense;
  SampledOptions sampled;
  UniformOptions uniform;
};

}  // namespace penumbra
