// solver/transport/solvers/light_solver.h
//
// The interface of methods that solve for the light in a scene, step by step. Callers (Pipeline, the window,
// user programs) depend on this interface only.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/base/progress.h"
#include "solver/base/registry.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/leaf_visibility.h"
#include "solver/transport/solvers/dense_system.h"
#include "solver/transport/solvers/iteration_report.h"
#include "solver/transport/solvers/solver_options.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The kinds of steps.
enum class SolverStep : std::uint8_t {
  kIterate,  // one round of the method
  kCorrect,  // deferred correction by exact irradiance, after the last round
};
// "iterate" or "correct".
std::string_view StepName(SolverStep step);

// The counts of a solver so far.
struct SolverReport {
  std::vector<IterationReport> iterations;
  int most_iterations = 0;  // the largest number that Next() asks for; 0: unknown
  bool full = false;  // links should have been split, but would have been too many (SolverOptions::max_links)
  struct Dense {
    std::size_t unknowns = 0;
    DenseClosure closure;
    double form_factor_error = 0;  // DenseSystem::form_factor_error
  };
  std::optional<Dense> dense;  // only of solvers that assemble a system
};

// The constructor of a solver makes links or assembles a system, which may be cancelled.
class LightSolver {
 public:
  virtual ~LightSolver() = default;
  LightSolver(const LightSolver&) = delete;
  LightSolver& operator=(const LightSolver&) = delete;

  // False if the construction was cancelled: the scene is then lit by emittance only.
  virtual bool Ready() const = 0;
  // The step that brings the light closer to the solution. Nothing if the light is solved, or if the options
  // allow no more steps.
  virtual std::optional<SolverStep> Next() const = 0;
  // Makes one step, whether or not Next() names it. False if the step was cancelled or the method has no such
  // step. A cancelled round leaves the light unchanged; a cancelled correction keeps its completed passes.
  virtual bool Step(SolverStep step, const ExecutionContext& context) = 0;
  // True if no round would change the light by more than the options allow.
  virtual bool Converged() const = 0;

  // The current light, as sources of further light.
  virtual const RadiositySolution& solution() const = 0;
  virtual const SolverReport& report() const = 0;

  // Recomputes the light after the scene's emittances or reflectances have changed, as one round, and drops
  // corrections. False if cancelled, or if a new solver is necessary.
  virtual bool Relight(const ExecutionContext& context) = 0;
  // True if SetLight() is available: another stage may replace the light.
  virtual bool TakesLight() const = 0;
  // Takes the given irradiance as exact: that of the leaves, by element [W/m^2], and that of the fragments,
  // which replace the solution's fragments. Adds the bounces of the change. False if cancelled; the light is
  // then unchanged. REQUIRES: TakesLight(); the fragments ascend by leaf, tile their leaf, and have the
  // leaf's irradiance as their area-weighted mean.
  virtual bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                        const ExecutionContext& context) = 0;

  // PointIrradianceOptions::part_of_tolerance for the amount of light that returns in this scene [1].
  virtual double PartOfTolerance() const = 0;
  // The visibility of the solution's leaves. Null if its computation was cancelled.
  virtual std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) = 0;
  // The area-weighted mean irradiance of the front sides of all patches, for each bounce [W/m^2]: entry 0
  // is light from emitters, entry k light that was reflected k times. Empty if the method does not provide
  // it.
  virtual std::vector<Rgb> MeanIrradianceByBounce(int bounces) const = 0;

 protected:
  LightSolver() = default;
};

// Called after each complete step.
using StepObserver = std::function<void(SolverStep)>;

// Makes the next step until there is none. All callers that solve to the end use this loop. False if
// cancelled.
bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer = {});

// The input of a solver. Scene and visibility must outlive the solver.
struct SolverScene {
  const Scene& scene;
  const PatchVisibility& visibility;
  // A solution of the same scene by the same method. The solver takes the solution and continues from it.
  // Null: none. A method that cannot Relight() leaves the solution alone and makes no solver, but null.
  RadiositySolution* goes_on_from = nullptr;
};

// The methods make solvers that are ready to step, unless the context is cancelled.
using LightSolverRegistry = Registry<LightSolver, SolverScene, LightSolverOptions, ExecutionContext>;

}  // namespace penumbra
