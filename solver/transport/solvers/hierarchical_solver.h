// solver/transport/solvers/hierarchical_solver.h
//
// The hierarchical radiosity solver (thesis, chapter 4; Hanrahan, Salzman and Aupperle 1991): gathers over
// links, pushes and pulls light through the quadtrees, and refines links, until changes are below the
// relative cut-off.
//
// Links control refinement and make iterations cheap, but each link has an error of up to eps, and the errors
// of sources add up to missing energy. The solver therefore corrects the converged solution (deferred
// correction, Stetter 1978): it computes the exact irradiance of every leaf from all leaves
// (IrradianceAtPoint), adds (exact irradiance - irradiance from the links) to the irradiance of the leaf, and
// gathers the reflections of this difference over the links. Each pass multiplies the error of the light
// transport by the relative error of the links, which is a few percent.

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
  // Makes links between the roots. If the context is cancelled, the solution has no links. The scene and the
  // visibility must outlive the solver.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     const ExecutionContext& context = ExecutionContext());
  // Continues from a solution of the same scene: takes over its links, and its light including corrections.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     RadiositySolution solution, const ExecutionContext& context = ExecutionContext());

  bool Ready() const override { return links_.Linked(); }
  std::optional<SolverStep> Next() const override;
  bool Step(SolverStep step, const ExecutionContext& context) override;
  bool Converged() const override { return links_.Converged(); }
  const RadiositySolution& solution() const override { return links_.solution(); }
  const SolverReport& report() const override { return report_; }
  // Gathers over the existing links until the light has converged; computes no form factors. The resulting
  // light is a linear function of the emittances.
  bool Relight(const ExecutionContext& context) override;
  bool TakesLight() const override { return true; }
  // Makes one pass of deferred correction, with exact irradiance that the caller has computed.
  bool SetLight(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                const ExecutionContext& context) override;
  // REQUIRES: corrections do not cut leaves (SolverOptions::source_error is 0).
  std::unique_ptr<LightSolver> LitAs(const Scene& other, const ExecutionContext& context) const override;
  void ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) override;
  double PartOfTolerance() const override;
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(
      const ExecutionContext& context = ExecutionContext()) override;
  // The light is computed over the links, without corrections.
  std::vector<Rgb> MeanIrradianceByBounce(int bounces) const override;

  // One iteration: gathers with push-pull until the cut-off is met; splits every link that the oracle
  // rejects, and then rejected links among the new ones; gathers over the new links. Returns a report. The
  // solution has converged when links_split == 0 and the residual is below the cut-off. Returns nullopt, and
  // leaves the solution unchanged, if cancelled.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);
  // One pass of deferred correction. Returns the root mean square change of the leaves' irradiance, relative
  // to the mean irradiance; nullopt if cancelled. A later iteration that refines links drops the corrections.
  // If SolverOptions::source_error > 0, the pass cuts the leaves into new parts and ignores `sampling`: the
  // parts determine the sample points.
  std::optional<double> Correct(LeafSampling sampling, const ExecutionContext& context);
  // Makes all passes of deferred correction that the options request. Returns false if cancelled; the
  // corrections of completed passes are kept.
  bool CorrectAll(const ExecutionContext& context);
  // Makes all remaining steps. If cancelled, the solution is that of the last complete step. Returns the
  // reports of the complete iterations.
  std::vector<IterationReport> Solve(const ExecutionContext& context);

  // True if refinement stopped because the number of links would have exceeded SolverOptions::max_links.
  bool Full() const { return links_.Full(); }
  RadiositySolution TakeSolution() && { return std::move(links_.solution()); }

 private:
  // The state that a cancelled step restores.
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
  // Like Correct(), with parts of leaves so small that their constant radiosity causes a relative error of at
  // most about `error`.
  std::optional<double> CorrectByCells(double error, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  LinkSolver links_;
  DeferredCorrection correction_;
  bool corrected_ = false;  // CorrectAll() has finished, and its corrections are still in place
  SolverReport report_;
  std::size_t relit_at_ = 0;  // the number of iterations before those of the present light
  LeafVisibilityCache seen_from_leaves_;
};

LightSolverRegistry::Method HierarchicalSolverMethod();

}  // namespace penumbra
