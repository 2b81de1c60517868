// solver/transport/solvers/light_solver.h
//
// The interface of methods that solve for the light in a scene, step by step. Callers (Pipeline, the window,
// user programs) depend on LightSolver only.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "solver/base/check.h"
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

// How many times a receiver of the transport operator meets a source. A link, or a pair of elements of a
// dense system, is smooth if nothing can block any of it, and sharp if blockers may hide a part. An
// interaction is sampled if a ray decides on it.
struct InteractionCounts {
  std::size_t smooth = 0, sharp = 0, sampled = 0;
};

// Statistics about the work that a solver has done so far.
struct SolverReport {
  std::vector<IterationReport> iterations;
  int most_iterations = 0;  // the largest number that Next() asks for; 0: unknown
  bool full = false;  // links should have been split, but would have been too many (SolverOptions::max_links)
  InteractionCounts interactions;  // those that are no links of the solution
  struct Dense {
    std::size_t unknowns = 0;
    DenseClosure closure;
    double form_factor_error = 0;  // DenseSystem::form_factor_error
  };
  std::optional<Dense> dense;  // only of solvers that assemble a system
};

// The constructor of a derived class makes links or assembles a system of equations; the user may cancel this
// work.
class LightSolver {
 public:
  virtual ~LightSolver() = default;
  LightSolver(const LightSolver&) = delete;
  LightSolver& operator=(const LightSolver&) = delete;

  // False if the construction was cancelled: the scene is then lit by emittance only.
  virtual bool Ready() const = 0;
  // The next step towards the solution; nullopt if the light has converged, or if the options allow no more
  // steps.
  virtual std::optional<SolverStep> Next() const = 0;
  // Makes one step, whether or not Next() returns this step. Returns false if the step was cancelled or the
  // method has no such step. A cancelled iteration leaves the light unchanged; a cancelled correction keeps
  // its completed passes.
  virtual bool Step(SolverStep step, const ExecutionContext& context) = 0;
  // True if no further iteration would change the light by more than the options allow.
  virtual bool Converged() const = 0;

  // The current solution, whose leaves and fragments are the sources of light for other stages.
  virtual const RadiositySolution& solution() const = 0;
  virtual const SolverReport& report() const = 0;

  // Recomputes the light after the scene's emittances or reflectances have changed, as one iteration, and
  // drops the corrections. Returns false if cancelled, or if a new solver is necessary.
  virtual bool Relight(const ExecutionContext& context) = 0;
  // True if SetLight() is available, by which another stage replaces the light.
  virtual bool TakesLight() const = 0;
  // Replaces the irradiance of the leaves by exact values: `irradiance`, indexed by ElementId [W/m^2], and
  // the irradiances of `fragments`, which replace the solution's fragments. SetLight() then adds the light
  // that arises from the change of irradiance by further reflections. Returns false, and leaves the light
  // unchanged, if cancelled. REQUIRES: TakesLight() is true; the fragments are sorted by leaf and tile their
  // leaf; the area-weighted mean of their irradiances is the irradiance of the leaf.
  virtual bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                        const ExecutionContext& context) = 0;

  // A solver with the same elements and form factors for a scene of the same patches with other emittances or
  // reflectances. It is lit by that scene: as after Relight(), and corrected if no other stage corrects the
  // light of this solver (TakesLight). Null if cancelled, or if the method has no such solver. `other` and
  // what this solver was made from must outlive the result.
  virtual std::unique_ptr<LightSolver> LitAs(const Scene& /*other*/, const ExecutionContext&) const {
    return nullptr;
  }
  // Sets the irradiance of all elements and of the solution's fragments [W/m^2], and what follows from it, as
  // it is: unlike SetLight(), adds no reflections. Only of solvers that have LitAs().
  virtual void ReplaceLight(std::span<const Rgb> /*element*/, std::span<const Rgb> /*fragment*/) {
    PENUMBRA_CHECK(false);
  }

  // The value of PointIrradianceOptions::part_of_tolerance that suits the reflectances of this scene [1].
  virtual double PartOfTolerance() const = 0;
  // The visibility of the solution's leaves; null if the computation was cancelled.
  virtual std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) = 0;
  // The area-weighted mean irradiance of the front sides of all patches, for each bounce [W/m^2]: entry 0
  // is light from emitters, entry k light that was reflected k times. The list is empty if the method does
  // not compute means by bounce.
  virtual std::vector<Rgb> MeanIrradianceByBounce(int bounces) const = 0;

 protected:
  LightSolver() = default;
};

// A function that is called after each complete step.
using StepObserver = std::function<void(SolverStep)>;

// Makes the step Next() until Next() returns nullopt. All callers that solve to the end use
// SolveStepByStep(). Returns false if cancelled.
bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer = {});

// Finds the pairs of patches that may see each other, at the first call; all calls return the same object.
// The object has no pairs if the context is cancelled.
using PairFinder = std::function<const PatchVisibility&(const ExecutionContext&)>;

// The input of a solver. The scene and the result of `pairs` outlive the solver.
struct SolverScene {
  const Scene& scene;
  PairFinder pairs;
  // If not null, a solution of the same scene by the same method. The new solver moves the solution into
  // itself and continues from there. A method without Relight() does not touch the solution, and makes a null
  // pointer instead of a solver.
  RadiositySolution* goes_on_from = nullptr;
};

// A method makes a solver that is ready for its first step, unless the context is cancelled.
using LightSolverRegistry = Registry<LightSolver, SolverScene, LightSolverOptions, ExecutionContext>;

}  // namespace penumbra
