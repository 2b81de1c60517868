// solver/transport/solvers/light_solver.h
//
// LightSolver is the interface of all methods that solve for the light in a scene, step by step. Callers
// (Pipeline, the viewer's window, user programs) depend on LightSolver only, not on a particular method.

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

// The kinds of steps of a solver.
enum class SolverStep : std::uint8_t {
  kIterate,  // one iteration of the solver; in some methods, one shot of light or one sweep over all elements
  kCorrect,  // deferred correction by exact irradiance, after the last iteration
  // kSweep and kSplit are the parts of one iteration of the hierarchical solver.
  kSweep,  // one gather over all links, with push-pull
  kSplit,  // one level of link splitting: splits each link that the oracle rejects, once
};
// The name of a kind of step: "iterate", "correct", "sweep" or "split".
std::string_view StepName(SolverStep step);

// The numbers of interactions (receiver-source pairs) of the light transport operator. An interaction is a
// link between elements, or a pair of elements of a dense system. An interaction is smooth if no blocker can
// lie between receiver and source, and sharp if blockers may hide a part of the source. An interaction is
// sampled if a ray determines which source the receiver sees.
struct InteractionCounts {
  std::size_t smooth = 0, sharp = 0, sampled = 0;
};

// Statistics about the work that a solver has done so far.
struct SolverReport {
  std::vector<IterationReport> iterations;
  int most_iterations = 0;  // the largest number of iterations that Next() requests; 0 if unknown
  // True if links were not split because the number of links would have exceeded SolverOptions::max_links.
  bool full = false;
  InteractionCounts interactions;  // numbers of those interactions that are not links of the solution
  struct Dense {
    std::size_t unknowns = 0;
    DenseClosure closure;
    double form_factor_error = 0;  // the value of DenseSystem::form_factor_error
  };
  std::optional<Dense> dense;  // data of the dense system; set only by solvers that assemble one
  // The report of the iteration that steps of the kinds kSweep and kSplit have begun but not completed; empty
  // if there is none.
  std::optional<IterationReport> begun = {};
};

// The constructor of a class derived from LightSolver makes links or assembles a system of equations; the
// user may cancel the constructor's work.
class LightSolver {
 public:
  virtual ~LightSolver() = default;
  LightSolver(const LightSolver&) = delete;
  LightSolver& operator=(const LightSolver&) = delete;

  // False if the construction of the solver was cancelled, so that the solution contains only emitted light.
  virtual bool Ready() const = 0;
  // The kind of the next step towards the solution; nullopt if the light has converged, or if the options
  // allow no more steps.
  virtual std::optional<SolverStep> Next() const = 0;
  // Makes one step of the given kind, whether or not Next() returns this kind. Step() returns false if the
  // step was cancelled or the solver makes no steps of the kind `step`. A cancelled iteration leaves the
  // light unchanged; a cancelled correction keeps its completed passes.
  virtual bool Step(SolverStep step, const ExecutionContext& context) = 0;
  // The kind of the next step, if the solver shall make the smallest possible steps: a part of the step that
  // Next() returns, or Next() itself if the solver does not divide steps into parts.
  virtual std::optional<SolverStep> NextSmall() const { return Next(); }
  // Returns a copy of the solver in its present state; the copy and the original then make steps
  // independently. `visibility` must equal the PatchVisibility from which the original was made. `visibility`
  // and the scene must outlive the copy. Copy() returns null if the solver does not support copies.
  virtual std::unique_ptr<LightSolver> Copy(const PatchVisibility& /*visibility*/) const { return nullptr; }
  // True if further iterations would change the light by no more than the cut-off in the solver's options.
  virtual bool Converged() const = 0;

  // The current solution, whose leaves and fragments (parts of leaves) are the sources of light for meshing
  // and display.
  virtual const RadiositySolution& solution() const = 0;
  virtual const SolverReport& report() const = 0;

  // Recomputes the light after the scene's emittances or reflectances have changed, and drops the deferred
  // corrections. The report counts the call of Relight() as one iteration. Relight() returns false if
  // cancelled, or if a new solver is necessary.
  virtual bool Relight(const ExecutionContext& context) = 0;
  // True if the solver supports SetLight(), by which the meshing stage replaces the light.
  virtual bool TakesLight() const = 0;
  // Replaces the irradiance of the leaves by exact values: `irradiance` is indexed by ElementId [W/m^2], and
  // `fragments`, the parts of cut leaves, replace the solution's fragments. After replacing the irradiance,
  // SetLight() adds the light that results from further reflections of the change of irradiance. If
  // cancelled, SetLight() returns false and leaves the light unchanged. REQUIRES: TakesLight() is true; the
  // fragments (parts of cut leaves) are sorted by leaf and tile their leaf; the irradiance of a leaf is the
  // area-weighted mean over its fragments.
  virtual bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                        const ExecutionContext& context) = 0;

  // A solver with the same elements and form factors for the scene `other`, which has the same patches but
  // other emittances or reflectances. The solver that LitAs() returns is lit by the scene `other`, as after
  // Relight(). The light of the returned solver includes deferred corrections, unless the meshing stage makes
  // the corrections (TakesLight). LitAs() returns null if cancelled, or if the method does not support other
  // emittances. The scene `other`, and all arguments of this solver's constructor, must outlive the solver
  // that LitAs() returns.
  virtual std::unique_ptr<LightSolver> LitAs(const Scene& /*other*/, const ExecutionContext&) const {
    return nullptr;
  }
  // Sets the irradiance of all elements and of all fragments (parts of cut leaves) [W/m^2], and the resulting
  // radiosities. Unlike SetLight(), ReplaceLight() adds no light by further reflections. Only solvers that
  // implement LitAs() implement ReplaceLight().
  virtual void ReplaceLight(std::span<const Rgb> /*element*/, std::span<const Rgb> /*fragment*/) {
    PENUMBRA_CHECK(false);
  }

  // The value of PointIrradianceOptions::part_of_tolerance that suits the reflectances of the scene [1].
  virtual double PartOfTolerance() const = 0;
  // The lists of sources and blockers that each leaf of the solution sees; null if the computation was
  // cancelled.
  virtual std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) = 0;
  // The area-weighted mean irradiance of the front sides of all patches, for each bounce [W/m^2]: entry 0 is
  // light from emitters, entry k is light that was reflected k times. MeanIrradianceByBounce() is empty if
  // the solver does not compute irradiance by bounce.
  virtual std::vector<Rgb> MeanIrradianceByBounce(int bounces) const = 0;

 protected:
  LightSolver() = default;
};

// A function that is called after each complete step of a solver.
using StepObserver = std::function<void(SolverStep)>;

// Makes the steps that Next() returns, until Next() returns nullopt. All callers that solve to the end use
// SolveStepByStep(). SolveStepByStep() returns false if cancelled.
bool SolveStepByStep(LightSolver& solver, const ExecutionContext& context, const StepObserver& observer = {});

// A function that returns the pairs of patches that may see each other; the first call finds the pairs, and
// all calls return the same object. If the search is cancelled (ExecutionContext), the returned
// PatchVisibility has no pairs.
using PairFinder = std::function<const PatchVisibility&(const ExecutionContext&)>;

// The input of a LightSolver: a scene, and the pairs of patches that may see each other. The scene and the
// PatchVisibility that `pairs` returns must outlive the solver.
struct SolverScene {
  const Scene& scene;
  PairFinder pairs;
  // If not null, `goes_on_from` is a solution of the same scene by the same method. The new solver takes over
  // the solution *goes_on_from by a move, and continues from this solution. A method without Relight() leaves
  // *goes_on_from untouched and returns a null pointer instead of a solver.
  RadiositySolution* goes_on_from = nullptr;
};

// The registry of solvers by name. Each entry of the registry makes a solver that is ready for its first
// step, unless the construction is cancelled.
using LightSolverRegistry = Registry<LightSolver, SolverScene, LightSolverOptions, ExecutionContext>;

}  // namespace penumbra
