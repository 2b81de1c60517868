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
#include <string>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/link_former.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/links/refinement.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/leaf_irradiance.h"
#include "solver/transport/solvers/settling.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

struct SolverOptions {
  double eps = 0.1;        // largest transport error of a link [W/m^2] (thesis, Appendix A, 1)
  double min_area = 1e-5;  // smallest area of an element [m^2] (Appendix A, 2)
  // Converged when no radiosity is farther off, relative to the largest reflected one (Appendix A, 7).
  double relative_cutoff = 1e-4;
  int max_iterations = 100;  // each gathers until it settles, then refines
  // Refinement ends before there are so many more links than between roots: some 800 MB.
  std::size_t max_links = 8'000'000;
  IterationScheme scheme = IterationScheme::kJacobi;
  Acceleration acceleration = Acceleration::kAnderson;
  std::string oracle = "transport";  // of RefinementOracles()
  // Refine by a larger eps first, lowered from one iteration to the next (Hanrahan, Salzman and Aupperle
  // 1991).
  bool multigrid = false;
  std::string form_factors = "cubature";  // of LinkFormFactorMethods()
  int max_corrections = 2;  // passes of exact irradiance over the leaves; 0: links alone, as in the thesis
  // What the points of corrections may leave out of their sources' detail (PointIrradiance::NearlyOnPatch);
  // 0: nothing.
  double correction_tolerance = 0;
  // About the largest relative error, where light arrives, that constant radiosity may cause: corrections cut
  // leaves into as many parts as that takes (LeafCells), after some passes with fewer. 0: only where contacts
  // cut them.
  double source_error = 0;
};

struct IterationReport {
  double residual = 0;  // bound of what is missing from any radiosity, relative to the largest reflected one
  double eps = 0;       // by which links were judged [W/m^2]
  std::size_t elements = 0, links = 0;
  std::size_t sweeps = 0;  // gathers with push-pull
  std::size_t links_split = 0;
  double seconds = 0;
};

// Whether another iteration would change nothing: the last ones split no link and brought the light no
// nearer.
bool IsStuck(std::span<const IterationReport> reports);

class HierarchicalSolver {
 public:
  // Links the roots. Cancelled, it leaves a solution without links. The scene and the visibility must outlive
  // the solver. Throws InputError if the options name an oracle or form factors that do not exist.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     const ExecutionContext& context = ExecutionContext());
  // Goes on from a solution of the same scene: its links and its light, corrections included. Throws
  // InputError as above.
  HierarchicalSolver(const Scene& scene, const PatchVisibility& visibility, const SolverOptions& options,
                     RadiositySolution solution, const ExecutionContext& context = ExecutionContext());
  ~HierarchicalSolver();
  HierarchicalSolver(const HierarchicalSolver&) = delete;
  HierarchicalSolver& operator=(const HierarchicalSolver&) = delete;

  // The steps. Each leaves the solution as it was if it is cancelled.

  // One iteration: gather and push-pull until the cut-off is met, then refine every link that the oracle
  // rejects, and its children in turn, and gather over the new links. Returns what it did; links_split == 0
  // and a residual below the cut-off mean convergence. Nothing if cancelled.
  std::optional<IterationReport> Iterate(const ExecutionContext& context);

  // Splits the leaves, moves what links end at them down to their children, balances the trees, and gathers
  // from the present light until it settles. Takes corrections back. The new links have not been judged:
  // Iterate() does. For refinement by other errors than transport's (thesis 4.4.2). Leaves on the last level
  // stay. False if cancelled.
  bool SubdivideLeaves(std::span<const ElementId> leaves, const ExecutionContext& context);

  // Gathers until the light settles after the scene's emittances or reflectances have changed, over the links
  // there are; no form factor is computed. The light is linear in the emittances. Takes corrections back:
  // Correct() or Iterate() may follow. Returns what it did; nothing if cancelled.
  std::optional<IterationReport> Relight(const ExecutionContext& context);

  // One pass of deferred correction. Returns the root mean square change of the leaves' irradiance, relative
  // to its mean; nothing if cancelled. An iteration that refines takes corrections back. With source_error
  // the parts of leaves are chosen anew, and the sampling is as theirs.
  std::optional<double> Correct(LeafSampling sampling, const ExecutionContext& context);
  // Takes the leaves' irradiance, by element, and that of fragments for exact, and gathers the bounces of
  // what this changes over the links: a pass of deferred correction whose means somebody else has computed.
  // The fragments replace the solution's. False if cancelled. REQUIRES: they ascend by leaf, tile theirs, and
  // average to its irradiance.
  bool CorrectTo(std::span<const Rgb> irradiance, std::vector<Fragment> fragments,
                 const ExecutionContext& context);
  // All passes that the options ask for, or all but the last, which the caller then makes by CorrectTo().
  // False if cancelled, which leaves those that were done.
  bool CorrectAll(const ExecutionContext& context, bool but_the_last = false);

  // Iterates to convergence, to the most iterations, or until the context is cancelled, then corrects. A
  // cancelled run leaves the solution of the last whole step. Returns the whole iterations.
  std::vector<IterationReport> Solve(const ExecutionContext& context);

  // The mean irradiance of the fronts by bounce [W/m^2], over the links, uncorrected: first what comes from
  // the emitters, then what that brings when it is reflected once, and so on.
  std::vector<Rgb> MeanIrradianceByBounce(int bounces) const;

  // Whether the roots were linked, which a cancelled construction did not do.
  bool Linked() const { return linked_; }
  bool Converged() const { return converged_; }
  // Links would have been split, but were too many (SolverOptions::max_links).
  bool Full() const { return full_; }
  const RadiositySolution& solution() const { return solution_; }
  // PointIrradianceOptions::part_of_tolerance, by how much light comes back.
  double PartOfTolerance() const;
  // What the leaves of the solution see: found when it is first asked for after they changed.
  // Null if it was cancelled.
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context = ExecutionContext());
  RadiositySolution TakeSolution() && { return std::move(solution_); }

 private:
  struct Snapshot;  // what a step that is cancelled goes back to
  Snapshot TakeSnapshot() const;
  void Restore(Snapshot snapshot);

  bool Settle(double cutoff, IterationReport& report, const ExecutionContext& context);
  bool Balance(const ExecutionContext& context);
  PointIrradianceOptions HowToSample() const;
  bool Apply(const RefinementPlan& plan, Snapshot& before, const ExecutionContext& context);
  void TakeCorrectionsBack();
  void LightFragments();
  // Correct() with parts of leaves that may err by so much.
  std::optional<double> CorrectByCells(double error, const ExecutionContext& context);

  const Scene& scene_;
  const PatchVisibility& visibility_;
  SolverOptions options_;
  double eps_;  // of the next iteration
  RadiositySolution solution_;
  std::unique_ptr<PushPull> push_pull_;
  std::shared_ptr<const LeafVisibility> seen_from_leaves_;  // null after leaves changed
  std::vector<Rgb> correction_;       // per element: exact less linked irradiance of leaves [W/m^2]
  std::vector<Rgb> fragment_offset_;  // per fragment: exact irradiance less its leaf's [W/m^2]
  bool linked_ = true;
  std::optional<bool> nearly_white_;  // once it is known
  double to_come_ = 0;                // LightToCome() when the light last settled
  std::vector<double> closure_;       // per element, of leaves that were asked for; negative where unknown
  std::vector<std::vector<Polygon3>>
      leaf_parts_;  // per leaf in ascending order, of LeafCells; empty at first
  bool converged_ = false, full_ = false;
  std::size_t root_links_ = 0;
};

}  // namespace penumbra
