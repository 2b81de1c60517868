#include "solver/transport/solvers/bounce_solver.h"

#include <algorithm>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/link_table.h"

namespace penumbra {
namespace {

constexpr std::size_t kMostBounces = 1000;

}  // namespace

BounceSolver::BounceSolver(const Scene& scene, const PatchVisibility& visibility,
                           const UniformOptions& options, const ExecutionContext& context)
    : UniformSolver(scene, visibility, options, kMostBounces), radiosity_(forest().size(), Rgb::Zero()) {
  for (std::size_t i = 0; i < leaves().size(); ++i)
    radiosity_[static_cast<std::size_t>(leaves()[i])] = MaterialOf(i).emittance;
  if (!context.Cancelled()) SetReady();
}

bool BounceSolver::Advance(IterationReport* report, const ExecutionContext& context) {
  const auto method = LinkFormFactorMethods().Make(options().form_factors, options().form_factor_options);
  std::vector<Rgb> irradiance(leaves().size(), Rgb::Zero());
  for (PatchId patch = 0; patch < static_cast<PatchId>(scene().patches.size()); ++patch) {
    std::vector<LinkCandidate> candidates;
    for (const PatchPair& pair : visibility().SourcesOf(patch))
      for (std::size_t i = FirstLeaf(pair.source); i < FirstLeaf(pair.source + 1); ++i)
        candidates.push_back({leaves()[i], visibility().Blockers(pair)});
    std::vector<LinkGroup> groups;
    for (std::size_t i = FirstLeaf(patch); i < FirstLeaf(patch + 1); ++i)
      groups.push_back({leaves()[i], candidates});
    const std::vector<LinkSet> sets = FormLinkGroups(forest(), groups, *method, context);
    if (context.Cancelled()) return false;
    for (std::size_t k = 0; k < sets.size(); ++k)
      for (const Link& link : sets[k].links)
        irradiance[FirstLeaf(patch) + k] +=
            link.form_factor * radiosity_[static_cast<std::size_t>(link.source)];
  }
  double change = 0, largest = 0, reflectance = 0;
  for (std::size_t i = 0; i < leaves().size(); ++i) {
    Rgb& radiosity = radiosity_[static_cast<std::size_t>(leaves()[i])];
    const Rgb reflected = MaterialOf(i).reflectance * irradiance[i];
    change = std::max(change, (MaterialOf(i).emittance + reflected - radiosity).abs().maxCoeff());
    largest = std::max(largest, reflected.maxCoeff());
    reflectance = std::max(reflectance, MaterialOf(i).reflectance.maxCoeff());
    radiosity = MaterialOf(i).emittance + reflected;
  }
  report->sweeps = 1;
  report->residual = largest > 0 ? reflectance / (1 - reflectance) * change / largest : 0;
  Show(irradiance);
  return true;
}

LightSolverRegistry::Method BounceSolverMethod() {
  return {"bounces",
          "bounce after bounce on a uniform mesh, with form factors computed anew",
          {"divisions", "form-factors", "relative-cutoff", "shots"},
          MakeUniformSolver<BounceSolver>};
}

}  // namespace penumbra
