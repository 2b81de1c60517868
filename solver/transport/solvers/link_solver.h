// solver/transport/solvers/link_solver.h
//
// The part of the hierarchical solver that works on links, the interactions between elements (thesis, chapter
// 4). LinkSolver solves for the light that the links transport, and splits links that a refinement oracle
// rejects.

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
#include "solver/transport/solvers/settling.h"
#include "solver/transport/solvers/solver_options.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// A LinkSolver solves for the light that links transport between elements. A LinkSolver holds the elements,
// the links, the light, and the state of refinement.
class LinkSolver {
 public:
  // The state of the LinkSolver before a step, which is restored if the step is cancelled.
  struct Snapshot {
    std::size_t elements = 0;
    // The links before the step; empty as long as the step has not replaced links.
    std::optional<LinkSet> links;
    std::vector<Fragment> fragments;
    std::vector<Rgb> irradiance, radiosity;
    std::vector<double> radiosity_spread, spread_below;
    bool converged = false;
  };

  // Makes links between the root elements of the quadtrees. If the computation is cancelled
  // (ExecutionContext), the LinkSolver has no links. The scene and the visibility must outlive the
  // LinkSolver.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             const ExecutionContext& context);
  // Continues with the links and the light of a solution of the same scene.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             RadiositySolution solution, const ExecutionContext& context);
  // A copy of `other` in its present state. `visibility` must equal the PatchVisibility from which `other`
  // was made, and must outlive the copy.
  LinkSolver(const LinkSolver& other, const PatchVisibility& visibility);
  LinkSolver(const LinkSolver&) = delete;
  LinkSolver& operator=(const LinkSolver&) = delete;

  Snapshot TakeSnapshot() const;
  // Restores the state of the snapshot. Restore() returns true if the set of elements has changed.
  bool Restore(Snapshot snapshot);

  // Makes sweeps (gathers over all links) until the distance of every radiosity from its limit is at most
  // `cutoff` times the largest reflected radiosity. Each sweep adds correction[leaf] [W/m^2] to the
  // irradiance that links bring to a leaf; `correction` is indexed by ElementId, or empty. Settle() returns
  // false if cancelled.
  bool Settle(std::span<const Rgb> correction, double cutoff, IterationReport& report,
              const ExecutionContext& context);
  bool Settle(std::span<const Rgb> correction, IterationReport& report, const ExecutionContext& context) {
    return Settle(correction, options_.relative_cutoff, report, context);
  }
  // Makes one sweep (a gather over all links), without Anderson acceleration. LinkSolver::Sweep() returns
  // false if cancelled.
  bool Sweep(std::span<const Rgb> correction, IterationReport& report, const ExecutionContext& context);
  // Splits every link that the refinement oracle rejects, and then the new links that the oracle rejects, for
  // at most `most_levels` levels of splitting. If `most_levels` is 0, Split() splits until the oracle accepts
  // all links. If any link is split, all fragments (parts into which leaves were cut) are deleted. Split()
  // returns false if cancelled.
  bool Split(Snapshot& before, IterationReport& report, const ExecutionContext& context, int most_levels = 0);
  // Completes the report of an iteration, tests for convergence, and lowers eps, the largest allowed link
  // error, for the next iteration (multigridding).
  void EndIteration(IterationReport& report);
  // Recomputes the radiosity of the leaves from their irradiance, after the materials of the scene have
  // changed.
  void ReflectAnew();

  bool Linked() const { return linked_; }
  bool Converged() const { return converged_; }
  // True if refinement of links stopped because the number of links would have exceeded
  // SolverOptions::max_links.
  bool Full() const { return full_; }
  // The largest allowed link error, eps, in the next iteration [W/m^2].
  double eps() const { return eps_; }
  // The residual at which sweeps end before the refinement oracle judges links; this residual increases with
  // the largest allowed link error eps.
  double Cutoff() const;
  // The result of LightToCome() in the last call of Settle() [1], in the channel where it is largest.
  double to_come() const { return to_come_; }
  const RadiositySolution& solution() const { return solution_; }
  RadiositySolution& solution() { return solution_; }
  const PushPull& push_pull() const { return *push_pull_; }

 private:
  bool Balance(const ExecutionContext& context);
  bool SettleBy(const SettlingOptions& how, std::span<const Rgb> correction, IterationReport& report,
                const ExecutionContext& context);
  bool Apply(const RefinementPlan& plan, Snapshot& before, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  double eps_;  // largest allowed link error in the next iteration [W/m^2]
  RadiositySolution solution_;
  std::unique_ptr<PushPull> push_pull_;
  bool linked_ = true;
  std::optional<bool> nearly_white_;  // true in nearly white rooms; empty until computed
  double to_come_ = 0;
  // closure (sum of form factors) of each leaf, indexed by ElementId; negative if not computed
  std::vector<double> closure_;
  bool converged_ = false, full_ = false;
  std::size_t root_links_ = 0;
};

// A room counts as nearly white if LightToCome() exceeds kNearlyWhite, which corresponds to reflectances
// above 0.95. In rooms that are not nearly white, reflections amplify the relative errors of links, which are
// a few thousandths, by a factor of at most about twenty, and deferred corrections remove the amplified
// errors.
inline constexpr double kNearlyWhite = 20;

}  // namespace penumbra
