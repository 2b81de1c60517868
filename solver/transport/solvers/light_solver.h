// solver/transport/solvers/light_solver.h
//
// A method that solves for the light in a scene, step by step. Whoever drives one (Pipeline, the window, a
// program of the user) knows no more of it than this.

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

// The steps that solvers are driven in.
enum class SolverStep : std::uint8_t {
  kIterate,  // one round of the method
  kCorrect,  // deferred correction by exact irradiance, which follows the last round
};
// "iterate" or "correct".
std::string_view StepName(SolverStep step);

// What a solver counted so far.
struct SolverReport {
  std::vector<IterationReport> iterations;
  bool full = false;  // links would have been split, but were too many (SolverOptions::max_links)
  struct Dense {
    std::size_t unknowns = 0;
    DenseClosure closure;
    double form_factor_error = 0;  // DenseSystem::form_factor_error
  };
  std::optional<Dense> dense;  // of solvers that assemble a system
};

// A solver is made ready to step: links are made, or a system is assembled. That may be cancelled.
class LightSolver {
 public:
  virtual ~LightSolver() = default;
  LightSolver(const LightSolver&) = delete;
  LightSolver& operator=(const LightSolver&) = delete;

  // False if the construction was cancelled: the scene is dark but for what surfaces emit.
  virtual bool Ready() const = 0;
  // The step that brings the light nearer to its end; nothing if the light is solved, or cannot be solved
  // further within the options.
  virtual std::optional<SolverStep> Next() const = 0;
  // Makes one step, whether or not it is the next one. False if it was cancelled, or if the method
  // has no such step: a round then leaves the light as it was, a correction leaves the passes that were made
  // whole.
  virtual bool Step(SolverStep step, const ExecutionContext& context) = 0;
  // No round would change the light by more than the options allow.
  virtual bool Converged() const = 0;

  // The light so far, as sources of further light.
  virtual const RadiositySolution& solution() const = 0;
  virtual const SolverReport& report() const = 0;

  // Lights the scene anew after its emittances or reflectances were changed, as one round; takes corrections
  // back. False if it was cancelled, or if the method has to be made anew for that.
  virtual bool Relight(const ExecutionContext& context) = 0;
  // Whether another stage may replace the light (SetLight).
  virtual bool TakesLight() const = 0;
  // Takes the irradiance of the leaves [W/m^2], by element, and that of the fragments for exact, and adds the
  // bounces of what this changes. The fragments replace the solution's. False if it was cancelled, which
  // leaves the light as it was. REQUIRES: TakesLight(); the fragments ascend by leaf, tile theirs, and
  // average to its irradiance.
  virtual bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                        const ExecutionContext& context) = 0;

  // PointIrradianceOptions::part_of_tolerance, by how much light comes back [1].
  virtual double PartOfTolerance() const = 0;
  // What the leaves of the solution see. Null if finding it was cancelled.
  virtual std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) = 0;
  // The mean irradiance of the fronts by bounce [W/m^2]: first what comes from the emitters, then what that
  // brings when it is reflected once, and so on. Empty where the method does not tell.
  virtual std::vector<Rgb> MeanIrradianceByBounce(int bounces) const = 0;

 protected:
  LightSolver() = default;
};

// Told of each step that was made whole.
using StepObserver = std::function<void(SolverStep)>;

// Makes the next step until there is none. Everyone who solves to the end steps by this loop. False if it was
// cancelled.
bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer = {});

// What a solver is made from. Scene and visibility must outlive the solver.
struct SolverScene {
  const Scene& scene;
  const PatchVisibility& visibility;
  // A solution of the same scene by the same method, which the solver takes and goes on from; null: none.
  // REQUIRES: null for methods that cannot be lit anew (Relight).
  RadiositySolution* goes_on_from = nullptr;
};

// Makes solvers, ready to step unless the context is cancelled.
using LightSolverRegistry = Registry<LightSolver, SolverScene, LightSolverOptions, ExecutionContext>;

}  // namespace penumbra
