// solver/transport/solvers/solver_options.h
//
// The options of the radiosity solvers.

#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "solver/transport/links/link_form_factor_method.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/settling.h"

namespace penumbra {

// Options of the hierarchical solver.
struct SolverOptions {
  // The largest transport error of a link between elements [W/m^2] (parameter 1 of the thesis, Appendix A).
  double eps = 0.1;
  double min_area = 1e-5;  // The smallest area of an element [m^2] (parameter 2 of the thesis, Appendix A).
  // The light has converged if |radiosity - limit| / (largest reflected radiosity) is at most relative_cutoff
  // for every element (parameter 7 of the thesis, Appendix A).
  double relative_cutoff = 1e-4;
  // The largest number of iterations; each iteration gathers until the light converges, then refines links.
  int max_iterations = 100;
  // Refinement stops before (number of links) - (number of links between root elements) exceeds max_links.
  // The default of max_links limits the memory of links to about 800 MB.
  std::size_t max_links = 8'000'000;
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";  // name of a refinement oracle in RefinementOracles()
  // If true, the first iteration allows a larger link error eps, and each iteration lowers eps
  // (multigridding; Hanrahan, Salzman and Aupperle 1991).
  bool multigrid = false;
  std::string form_factors = "cubature";  // name of a method in LinkFormFactorMethods()
  LinkFormFactorOptions form_factor_options;
  // The number of passes of deferred correction by exact irradiance; with 0, links alone transport light, as
  // in the thesis.
  int max_corrections = 2;
  // If true, the meshing stage makes the last pass of deferred correction, by LightSolver::SetLight().
  bool last_correction_elsewhere = false;
  // The relative tolerance of the irradiance samples of deferred corrections
  // (PointIrradiance::NearlyOnPatch); with 0, the samples are exact.
  double correction_tolerance = 0;
  // The approximate limit of the relative error of irradiance that is caused by treating the radiosity of a
  // source as constant over parts of leaves. Deferred corrections cut leaves into as many parts as
  // source_error requires (LeafCells), after some passes with fewer parts. If source_error is 0, leaves are
  // cut only at contacts, where other surfaces touch them.
  double source_error = 0;
  // The occlusion method of deferred corrections; null for the fastest exact method.
  std::shared_ptr<const OcclusionMethod> occlusion = {};
};

// Options of the sampled solver.
struct SampledOptions {
  std::size_t elements = 20'000;  // the largest area of an element is (area of all fronts) / elements
  // Elements are divided until (deviation of direct light within the element) / (mean direct light) is at
  // most relative_spread.
  double relative_spread = 0.25;
  std::size_t max_elements = 8'000'000;
  std::size_t element_rays = 64;  // number of rays from each element in the last pass of the sampled solver
  std::size_t point_rays = 192;   // the value of RadiositySolution::rays_per_point
  int passes = 2;  // number of passes; each pass has smaller elements and more rays than the previous pass
  double relative_cutoff = 1e-4;  // limit of the residual, as for SolverOptions::relative_cutoff
};

// Options of the classic solvers on uniform meshes (UniformSolver).
struct UniformOptions {
  int divisions = 4;                      // number of elements along each side of a patch (UniformForest)
  std::string form_factors = "cubature";  // name of a method in LinkFormFactorMethods()
  // The options of the form-factor method that `form_factors` names. The members `rays` and `seed` also apply
  // to solvers that cast rays themselves.
  LinkFormFactorOptions form_factor_options;
  IterationScheme scheme = IterationScheme::kJacobi;
  // The light has converged if the residual of the solver, which each solver defines in its own way, is at
  // most relative_cutoff.
  double relative_cutoff = 1e-4;
  std::size_t shots = 0;  // the largest number of steps; 0 selects the default of the solver
  // If true, shots include light that the shooting patch will reflect later (Shao and Badler 1993).
  bool overshoot = false;
  // If true, solution() includes the ambient term, an estimate of the light that is not yet sent. The shots
  // do not use the ambient term.
  bool ambient = false;
};

// The options of all solvers. Each solver uses only the member of LightSolverOptions with its own name; all
// solvers on uniform meshes use `uniform`.
struct LightSolverOptions {
  SolverOptions hierarchical;
  DenseOptions dense;
  SampledOptions sampled;
  UniformOptions uniform;
};

}  // namespace penumbra
