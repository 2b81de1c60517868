// solver/transport/solvers/link_solver.h
//
// What links do (thesis, chapter 4): light settles on them, and oracles split them.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/links/refinement.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/solvers/iteration_report.h"
#include "solver/transport/solvers/solver_options.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// Elements and links, the light on them, and how far they are refined.
class LinkSolver {
 public:
  // What a step that is cancelled goes back to.
  struct Snapshot {
    std::size_t elements = 0;
    std::optional<LinkSet> links;  // once they have been replaced
    std::vector<Fragment> fragments;
    std::vector<Rgb> irradiance, radiosity;
    std::vector<double> radiosity_spread, spread_below;
    bool converged = false;
  };

  // Links the roots. Cancelled, it has no links. The scene and the visibility must outlive the solver.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             const ExecutionContext& context);
  // Goes on with the links and the light of a solution of the same scene.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             RadiositySolution solution, const ExecutionContext& context);

  Snapshot TakeSnapshot() const;
  // True if the elements are not those of before.
  bool Restore(Snapshot snapshot);

  // Sweeps until no radiosity is farther from its limit than `cutoff`, relative to the largest reflected one.
  // `correction` [W/m^2], by element or empty, is added to what links bring to leaves. False if it was
  // cancelled.
  bool Settle(std::span<const Rgb> correction, double cutoff, IterationReport& report,
              const ExecutionContext& context);
  bool Settle(std::span<const Rgb> correction, IterationReport& report, const ExecutionContext& context) {
    return Settle(correction, options_.relative_cutoff, report, context);
  }
  // Splits every link that the oracle rejects, and those that take its place in turn. Fragments are dropped
  // where links are split. False if it was cancelled.
  bool Split(Snapshot& before, IterationReport& report, const ExecutionContext& context);
  // Tells what an iteration left, judges convergence, and lowers eps for the next one (multigridding).
  void EndIteration(IterationReport& report);
  // Reflects the irradiance of the leaves anew, after the materials of the scene were changed.
  void ReflectAnew();

  bool Linked() const { return linked_; }
  bool Converged() const { return converged_; }
  // Links would have been split, but were too many (SolverOptions::max_links).
  bool Full() const { return full_; }
  // By which links are judged next [W/m^2].
  double eps() const { return eps_; }
  // How well the light has to settle before links are judged: coarse links need less.
  double Cutoff() const;
  // LightToCome() when the light last settled [1].
  double to_come() const { return to_come_; }
  const RadiositySolution& solution() const { return solution_; }
  RadiositySolution& solution() { return solution_; }
  const PushPull& push_pull() const { return *push_pull_; }

 private:
  bool Balance(const ExecutionContext& context);
  bool Apply(const RefinementPlan& plan, Snapshot& before, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  double eps_;  // of the next iteration
  RadiositySolution solution_;
  std::unique_ptr<PushPull> push_pull_;
  bool linked_ = true;
  std::optional<bool> nearly_white_;  // once it is known
  double to_come_ = 0;
  std::vector<double> closure_;  // per element, of leaves that were asked for; negative where unknown
  bool converged_ = false, full_ = false;
  std::size_t root_links_ = 0;
};

// Rooms are nearly white where so much light is still to come for each unit that is there: reflectances above
// 0.95. Below that the links' errors, some thousandths, come back some twenty times, which corrections mend.
inline constexpr double kNearlyWhite = 20;

}  // namespace penumbra
