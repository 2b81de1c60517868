#include "solver/transport/solvers/full_matrix_solver.h"

#include <algorithm>
#include <string>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/link_table.h"
#include "solver/transport/solvers/dense_solver.h"

namespace penumbra {
namespace {

constexpr std::size_t kMostMatrixSweeps = 100'000;
constexpr std::size_t kSweepGrain = 32;

}  // namespace

FullMatrixSolver::FullMatrixSolver(const Scene& scene, const PatchVisibility& visibility,
                                   const UniformOptions& options, const ExecutionContext& context)
    : UniformSolver(scene, visibility, options, kMostMatrixSweeps) {
  if (leaves().size() > kMostDenseUnknowns)
    throw InputError(scene.name + ": error: the matrix would have " + std::to_string(leaves().size()) +
                     " rows and can have " + std::to_string(kMostDenseUnknowns) +
                     "; ask for fewer divisions");
  irradiance_.assign(leaves().size(), Rgb::Zero());
  for (std::size_t i = 0; i < leaves().size(); ++i) radiosity_.push_back(MaterialOf(i).emittance);
  if (Assemble(context)) SetReady();
}

bool FullMatrixSolver::Assemble(const ExecutionContext& context) {
  const auto method = LinkFormFactorMethods().Make(options().form_factors, options().form_factor_options);
  std::vector<std::int32_t> place(forest().size(), -1);
  for (std::size_t i = 0; i < leaves().size(); ++i)
    place[static_cast<std::size_t>(leaves()[i])] = static_cast<std::int32_t>(i);
  first_.assign(1, 0);
  for (std::size_t p = 0; p < scene().patches.size(); ++p) {
    context.Report("assemble", static_cast<double>(p) / static_cast<double>(scene().patches.size()));
    const auto patch = static_cast<PatchId>(p);
    std::vector<LinkCandidate> candidates;
    for (const PatchPair& pair : visibility().SourcesOf(patch))
      for (std::size_t i = FirstLeaf(pair.source); i < FirstLeaf(pair.source + 1); ++i)
        candidates.push_back({leaves()[i], visibility().Blockers(pair)});
    std::vector<LinkGroup> groups;
    for (std::size_t i = FirstLeaf(patch); i < FirstLeaf(patch + 1); ++i)
      groups.push_back({leaves()[i], candidates});
    for (const LinkSet& set : FormLinkGroups(forest(), groups, *method, context)) {
      for (const Link& link : set.links)
        if (link.form_factor > 0)
          entries_.push_back({place[static_cast<std::size_t>(link.source)], link.form_factor});
      first_.push_back(entries_.size());
    }
    if (context.Cancelled()) return false;
  }
  return true;
}

Rgb FullMatrixSolver::Gather(std::size_t leaf, std::span<const Rgb> radiosity) const {
  Rgb sum = Rgb::Zero();
  for (std::size_t k = first_[leaf]; k < first_[leaf + 1]; ++k)
    sum += entries_[k].factor * radiosity[static_cast<std::size_t>(entries_[k].source)];
  return sum;
}

bool FullMatrixSolver::Advance(IterationReport* report, const ExecutionContext& context) {
  if (context.Cancelled()) return false;
  const std::vector<Rgb> before = radiosity_;
  const auto light = [&](std::size_t i, std::span<const Rgb> from) {
    irradiance_[i] = Gather(i, from);
    radiosity_[i] = MaterialOf(i).emittance + MaterialOf(i).reflectance * irradiance_[i];
  };
  if (options().scheme == IterationScheme::kJacobi)
    ParallelFor(radiosity_.size(), kSweepGrain, [&](std::size_t i) { light(i, before); });
  else
    for (std::size_t i = 0; i < radiosity_.size(); ++i) light(i, radiosity_);
  double change = 0, largest = 0, reflectance = 0;
  for (std::size_t i = 0; i < radiosity_.size(); ++i) {
    change = std::max(change, (radiosity_[i] - before[i]).abs().maxCoeff());
    largest = std::max(largest, (radiosity_[i] - MaterialOf(i).emittance).maxCoeff());
    reflectance = std::max(reflectance, MaterialOf(i).reflectance.maxCoeff());
  }
  report->residual = largest > 0 ? reflectance / (1 - reflectance) * change / largest : 0;
  report->sweeps = 1;
  Show(irradiance_);
  return true;
}

LightSolverRegistry::Method FullMatrixSolverMethod() {
  return {"full-matrix",
          "all form factors between the elements of a uniform mesh, and sweeps by Jacobi or Gauss and Seidel "
          "(Cohen and Greenberg 1985)",
          {"divisions", "form-factors", "relative-cutoff", "scheme", "shots"},
          MakeUniformSolver<FullMatrixSolver>};
}

}  // namespace penumbra
