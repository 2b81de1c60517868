#include "solver/transport/solvers/progressive_solver.h"

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/link_table.h"

namespace penumbra {

ProgressiveSolver::ProgressiveSolver(const Scene& scene, const PatchVisibility& visibility,
                                     const UniformOptions& options, const ExecutionContext& context)
    : ShootingSolver(scene, visibility, options),
      method_(LinkFormFactorMethods().Make(options.form_factors, options.form_factor_options)) {
  if (!context.Cancelled()) SetReady();
}

std::vector<double> ProgressiveSolver::FormFactorsOf(PatchId shooter, const ExecutionContext& context) const {
  return method_->SeesAllAtOnce() ? FromShooter(shooter, context) : FromReceivers(shooter, context);
}

// F(shooter -> element) for all elements in one view; reciprocity gives F(element <- shooter).
std::vector<double> ProgressiveSolver::FromShooter(PatchId shooter, const ExecutionContext& context) const {
  std::vector<LinkCandidate> candidates;
  std::vector<std::size_t> place(forest().size(), 0);
  for (const PatchPair& pair : visibility().SourcesOf(shooter))
    for (std::size_t i = FirstLeaf(pair.source); i < FirstLeaf(pair.source + 1); ++i) {
      candidates.push_back({leaves()[i], visibility().Blockers(pair)});
      place[static_cast<std::size_t>(leaves()[i])] = i;
    }
  const ElementId root = ElementForest::Root(shooter);
  std::vector<double> row(leaves().size(), 0);
  for (const Link& link : FormLinks(forest(), root, candidates, *method_, context).links)
    row[place[static_cast<std::size_t>(link.source)]] =
        link.form_factor * forest()[root].area / forest()[link.source].area;
  return row;
}

std::vector<double> ProgressiveSolver::FromReceivers(PatchId shooter, const ExecutionContext& context) const {
  std::vector<LinkGroup> groups;
  std::vector<std::size_t> place;
  for (const PatchPair& pair : visibility().SourcesOf(shooter))
    for (std::size_t i = FirstLeaf(pair.source); i < FirstLeaf(pair.source + 1); ++i) {
      groups.push_back({leaves()[i], {{ElementForest::Root(shooter), visibility().Blockers(pair)}}});
      place.push_back(i);
    }
  std::vector<double> row(leaves().size(), 0);
  const std::vector<LinkSet> sets = FormLinkGroups(forest(), groups, *method_, context);
  for (std::size_t g = 0; g < sets.size(); ++g)
    for (const Link& link : sets[g].links) row[place[g]] = link.form_factor;
  return row;
}

LightSolverRegistry::Method ProgressiveSolverMethod() {
  return {"progressive",
          "progressive refinement: the patch with the most unsent light shoots at the elements of all others "
          "(Cohen, Chen, Wallace and Greenberg 1988)",
          {"divisions", "form-factors", "relative-cutoff", "shots", "overshoot", "ambient"},
          MakeUniformSolver<ProgressiveSolver>};
}

}  // namespace penumbra
