// solver/transport/solvers/hierarchical_solver.h
//
// The hierarchical radiosity solver (thesis, chapter 4; Hanrahan, Salzman and Aupperle 1991): gather over
// links, push-pull through the quadtrees, refine links, until nothing changes beyond the relative cut-off.
//
// Links are what refinement is steered by and what iterations cost little with, but each of them errs by up
// to eps, and the errors of sources add up to missing energy. So the converged solution is corrected: the
// exact irradiance of every leaf from all leaves (IrradianceAtPoint) less what the links bring is added to
// the leaf, and the bounces of that are gathered over the links again. This is deferred correction (Stetter
// 1978): each pass multiplies the error of the transport by the relative error of the links, some hundredths.

#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/leaf_irradiance.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/deferred_correction.h"
#include "solver/transport/solvers/light_solver.h"
#include "solver/transport/solvers/link_solver.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

class HierarchicalSolver final : public LightSolver {
 public:
  // Links the roots. Cancelled, it leaves a solution without links. The scene and the visibility must outlive
  // the solver.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     const ExecutionContext& context = ExecutionContext());
  // Goes on from a solution of the same scene: its links and its light, corrections included.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     RadiositySolution solution, const ExecutionContext& context = ExecutionContext());

  bool Ready() const override { return links_.Linked(); }
  std::optional<SolverStep> Next() const override;
  bool Step(SolverStep step, const ExecutionContext& context) override;
  bool Converged() const override { return links_.Converged(); }
  const RadiositySolution& solution() const override { return links_.solution(); }
  const SolverReport& report() const override { return report_; }
  // Gathers until the light settles over the links there are; no form factor is computed. The light is linear
  // in the emittances.
  bool Relight(const ExecutionContext& context) override;
  bool TakesLight() const override { return true; }
  // A pass of deferred correction whose means somebody else has computed.
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) override;
  double PartOfTolerance() const override;
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(
      const ExecutionContext& context = ExecutionContext()) override;
  // Over the links, uncorrected.
  std::vector<Rgb> MeanIrradianceByBounce(int bounces) const override;

  // One iteration: gather and push-pull until the cut-off is met, then refine every link that the oracle
  // rejects, and its children in turn, and gather over the new links. Returns what it did; links_split == 0
  // and a residual below the cut-off mean convergence. Nothing if cancelled, which leaves the solution as it
  // was.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // One pass of deferred correction. Returns the root mean square change of the leaves' irradiance, relative
  // to its mean; nothing if cancelled. An iteration that refines takes corrections back. With source_error
  // the parts of leaves are chosen anew, and the sampling is as theirs.
  std::optional<double> Correct(LeafSampling sampling, const ExecutionContext& context);
  // All passes that the options ask for. False if cancelled, which leaves those that were done.
  bool CorrectAll(const ExecutionContext& context);
  // All steps. A cancelled run leaves the solution of the last whole one. Returns the whole iterations.
  std::vector<IterationReport> Solve(const ExecutionContext& context);

  // Links would have been split, but were too many (SolverOptions::max_links).
  bool Full() const { return links_.Full(); }
  RadiositySolution TakeSolution() && { return std::move(links_.solution()); }

 private:
  // What a step that is cancelled goes back to.
  struct Snapshot {
    LinkSolver::Snapshot links;
    DeferredCorrection correction;
  };
  Snapshot TakeSnapshot() const;
  void Restore(Snapshot snapshot);
  PointIrradianceOptions HowToSample() const;
  void TakeCorrectionsBack();
  std::optional<double> AddExact(LeafSampling sampling, const ExecutionContext& context);
  // Correct() with parts of leaves that may err by so much.
  std::optional<double> CorrectByCells(double error, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  LinkSolver links_;
  DeferredCorrection correction_;
  bool corrected_ = false;  // CorrectAll() came to its end, and nothing took that back
  SolverReport report_;
  std::shared_ptr<const LeafVisibility> seen_from_leaves_;  // null after leaves changed
};

LightSolverRegistry::Method HierarchicalSolverMethod();

}  // namespace penumbra
