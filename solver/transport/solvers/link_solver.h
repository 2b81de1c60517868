// solver/transport/solvers/link_solver.h
//
// The part of the hierarchical solver that works on links (thesis, chapter 4): solves for the light that the
// links transport, and splits links by means of an oracle.

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

// Solves for the light on elements over the links between them. The object holds the elements, the links,
// the light, and the state of refinement.
class LinkSolver {
 public:
  // The state that a cancelled step restores.
  struct Snapshot {
    std::size_t elements = 0;
    std::optional<LinkSet> links;  // set once links have been replaced
    std::vector<Fragment> fragments;
    std::vector<Rgb> irradiance, radiosity;
    std::vector<double> radiosity_spread, spread_below;
    bool converged = false;
  };

  // Makes links between the roots. If the context is cancelled, the solver has no links. The scene and the
  // visibility must outlive the solver.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             const ExecutionContext& context);
  // Continues with the links and the light of a solution of the same scene.
  LinkSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
             RadiositySolution solution, const ExecutionContext& context);

  Snapshot TakeSnapshot() const;
  // Restores the state of the snapshot. Returns true if the set of elements has changed.
  bool Restore(Snapshot snapshot);

  // Sweeps until the distance of every radiosity from its limit is at most `cutoff` times the largest
  // reflected radiosity. Adds correction[leaf] [W/m^2] to the light that links bring to a leaf; `correction`
  // is indexed by ElementId, or empty. Returns false if cancelled.
  bool Settle(std::span<const Rgb> correction, double cutoff, IterationReport& report,
              const ExecutionContext& context);
  bool Settle(std::span<const Rgb> correction, IterationReport& report, const ExecutionContext& context) {
    return Settle(correction, options_.relative_cutoff, report, context);
  }
  // Splits every link that the oracle rejects, and then rejected links among the new ones. If any link is
  // split, the fragments of leaves are deleted. Returns false if cancelled.
  bool Split(Snapshot& before, IterationReport& report, const ExecutionContext& context);
  // Completes the report of an iteration, tests for convergence, and lowers eps for the next iteration
  // (multigridding).
  void EndIteration(IterationReport& report);
  // Recomputes the radiosity of the leaves from their irradiance, after the materials of the scene have
  // changed.
  void ReflectAnew();

  bool Linked() const { return linked_; }
  bool Converged() const { return converged_; }
  // True if refinement stopped because the number of links would have exceeded SolverOptions::max_links.
  bool Full() const { return full_; }
  // The eps of the next iteration [W/m^2].
  double eps() const { return eps_; }
  // The residual at which sweeps end before the oracle judges links; it increases with eps.
  double Cutoff() const;
  // The result of LightToCome() in the last call of Settle() [1], for the largest channel.
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
  std::optional<bool> nearly_white_;  // empty until computed
  double to_come_ = 0;
  std::vector<double> closure_;  // by element, for leaves that were computed; negative: unknown
  bool converged_ = false, full_ = false;
  std::size_t root_links_ = 0;
};

// A room counts as nearly white if LightToCome() exceeds this number, which corresponds to reflectances above
// 0.95. In rooms that are not nearly white, errors of links, which are a few thousandths, are amplified by a
// factor of at most about twenty, and deferred corrections remove them.
inline constexpr double kNearlyWhite = 20;

}  // namespace penumbra
