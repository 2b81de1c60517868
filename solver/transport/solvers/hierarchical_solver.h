// solver/transport/solvers/hierarchical_solver.h
//
// The hierarchical radiosity solver (thesis, chapter 4; Hanrahan, Salzman and Aupperle 1991): gathers light
// over links between elements, pushes and pulls the light through the quadtrees, and refines links, until
// relative changes of radiosity are below a cut-off.
//
// Links (hierarchical interactions between elements) control refinement and make iterations cheap. However,
// each link has a transport error of up to eps [W/m^2], and the errors of many links add up to missing
// energy. The solver therefore improves the converged solution by deferred correction (Stetter 1978): the
// solver computes the exact irradiance of every leaf from all leaves and adds (exact irradiance - irradiance
// from the links) to the irradiance of the leaf. After the correction of the leaves, the hierarchical solver
// gathers the reflections of the added irradiance over the links. Each pass of deferred correction multiplies
// the error of the light transport by the relative error of the links, which is a few percent.

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
  // Makes links between the root elements of the quadtrees. If the computation is cancelled
  // (ExecutionContext), the solution has no links. The scene and the visibility must outlive the solver.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     const ExecutionContext& context = ExecutionContext());
  // Continues from an earlier solution of the same scene: takes over the links, and the light with its
  // deferred corrections.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     RadiositySolution solution, const ExecutionContext& context = ExecutionContext());

  bool Ready() const override { return links_.Linked(); }
  std::optional<SolverStep> Next() const override;
  bool Step(SolverStep step, const ExecutionContext& context) override;
  // NextSmall() divides an iteration into small steps: kSweep until the residual is below a cut-off, then
  // kSplit once, and so on until no link is split. When no iteration remains, NextSmall() returns Next().
  // Because each kSplit step judges links by the latest light, small steps and whole iterations split
  // different links; their converged light agrees up to the relative cut-off.
  std::optional<SolverStep> NextSmall() const override;
  std::unique_ptr<LightSolver> Copy(const PatchVisibility& visibility) const override;
  bool Converged() const override { return links_.Converged(); }
  const RadiositySolution& solution() const override { return links_.solution(); }
  const SolverReport& report() const override { return report_; }
  // Gathers over the existing links until the light has converged; computes no form factors. The light that
  // Relight() computes is a linear function of the emittances.
  bool Relight(const ExecutionContext& context) override;
  bool TakesLight() const override { return true; }
  // Makes one pass of deferred correction, with the exact irradiance of the leaves that the caller has
  // computed.
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) override;
  // REQUIRES: deferred corrections do not cut leaves into parts (SolverOptions::source_error is 0).
  std::unique_ptr<LightSolver> LitAs(const Scene& other, const ExecutionContext& context) const override;
  void ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) override;
  double PartOfTolerance() const override;
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(
      const ExecutionContext& context = ExecutionContext()) override;
  // The light of each bounce is computed over the links, without deferred corrections.
  std::vector<Rgb> MeanIrradianceByBounce(int bounces) const override;

  // One iteration gathers light with push-pull until the residual is below a cut-off, splits links, and
  // gathers over the new links. A link is split if the refinement oracle rejects the link; new links that the
  // oracle rejects are split in the same iteration. The solution has converged when an iteration splits no
  // link and the residual is below the cut-off. If cancelled, Iterate() returns nullopt and leaves the
  // solution unchanged.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // Makes one pass of deferred correction. Correct() returns (root mean square change of the leaves'
  // irradiance) / (mean irradiance), or nullopt if cancelled. If an iteration after Correct() refines links,
  // the deferred corrections are dropped. If SolverOptions::source_error > 0, the pass of deferred correction
  // cuts the leaves into new parts and ignores `sampling`: the parts determine the sample points.
  std::optional<double> Correct(LeafSampling sampling, const ExecutionContext& context);
  // Makes all passes of deferred correction that SolverOptions::max_corrections requests. CorrectAll()
  // returns false if cancelled; the corrections of completed passes are kept.
  bool CorrectAll(const ExecutionContext& context);
  // Makes all remaining iterations and deferred corrections. If Solve() is cancelled, the solution is that of
  // the last complete step. Solve() returns the reports of the complete iterations.
  std::vector<IterationReport> Solve(const ExecutionContext& context);

  // True if refinement of links stopped because the number of links would have exceeded
  // SolverOptions::max_links.
  bool Full() const { return links_.Full(); }
  RadiositySolution TakeSolution() && { return std::move(links_.solution()); }

 private:
  HierarchicalSolver(const HierarchicalSolver& other, const PatchVisibility& visibility);
  bool Sweep(const ExecutionContext& context);
  bool SplitOnce(const ExecutionContext& context);
  IterationReport& Begun();
  void EndBegun();

  // The state of the HierarchicalSolver before a step, which is restored if the step is cancelled.
  struct Snapshot {
    LinkSolver::Snapshot links;
    DeferredCorrection correction;
    bool corrected = false;
  };
  Snapshot TakeSnapshot() const;
  void Restore(Snapshot snapshot);
  PointIrradianceOptions HowToSample() const;
  void TakeCorrectionsBack();
  void FindCorrections();
  std::optional<double> AddExact(LeafSampling sampling, const ExecutionContext& context);
  // Like Correct(), but first cuts the leaves into parts so small that treating the radiosity of a part as
  // constant causes a relative error of irradiance of at most about `error`.
  std::optional<double> CorrectByCells(double error, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  LinkSolver links_;
  DeferredCorrection correction_;
  // True if CorrectAll() has finished and its corrections are still part of the light.
  bool corrected_ = false;
  SolverReport report_;
  std::size_t relit_at_ = 0;  // index in report_.iterations of the first iteration after the last Relight()
  LeafVisibilityCache seen_from_leaves_;
};

LightSolverRegistry::Method HierarchicalSolverMethod();

}  // namespace penumbra
