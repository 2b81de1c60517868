#include "solver/transport/solvers/dense_solver.h"

#include <cmath>
#include <string>
#include <utility>

#include <Eigen/LU>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// Sets the light of parents to the area-weighted means of their children, and the spreads to those of the
// leaves below.
void Average(RadiositySolution& solution) {
  const ElementForest& forest = solution.forest;
  const std::size_t count = forest.size();
  solution.radiosity_spread.assign(count, 0);
  solution.spread_below.assign(count, 0);
  // Children have larger numbers than their parents.
  for (std::size_t e = count; e-- > 0;) {
    const auto id = static_cast<ElementId>(e);
    const Element& element = forest[id];
    if (element.IsLeaf()) continue;
    Rgb irradiance = Rgb::Zero(), radiosity = Rgb::Zero();
    double area = 0;
    for (ElementId child = element.first_child; child < element.first_child + 4; ++child) {
      irradiance += forest[child].area * solution.irradiance[child];
      radiosity += forest[child].area * solution.radiosity[child];
      area += forest[child].area;
    }
    solution.irradiance[e] = irradiance / area;
    solution.radiosity[e] = radiosity / area;
    double spread = 0, below = 0;
    for (ElementId child = element.first_child; child < element.first_child + 4; ++child) {
      const double off = (solution.radiosity[child] - solution.radiosity[e]).abs().maxCoeff();
      const double own = solution.radiosity_spread[child] * solution.radiosity_spread[child];
      spread += forest[child].area * (own + off * off);
      below += forest[child].area * own;
    }
    solution.radiosity_spread[e] = std::sqrt(spread / area);
    solution.spread_below[e] = std::sqrt(below / area);
  }
}

// The pairs of elements that see each other.
InteractionCounts CountPairs(const DenseSystem& system, const PatchVisibility& visibility) {
  const auto elements = [&](PatchId patch) {
    const auto p = static_cast<std::size_t>(patch);
    return system.first_of_patch[p + 1] - system.first_of_patch[p];
  };
  InteractionCounts counts;
  for (PatchId receiver = 0; receiver + 1 < static_cast<PatchId>(system.first_of_patch.size()); ++receiver)
    for (const PatchPair& pair : visibility.SourcesOf(receiver))
      (pair.visibility == Visibility::kVisible ? counts.smooth : counts.sharp) +=
          elements(receiver) * elements(pair.source);
  return counts;
}

}  // namespace

DenseLight SolveDense(const DenseSystem& system) { return SolveDense(system, system.forest.scene()); }

DenseLight SolveDense(const DenseSystem& system, const Scene& scene) {
  std::vector<Rgb> emittance, reflectance;
  for (std::size_t i = 0; i < system.size(); ++i) {
    const Material& material = scene.MaterialOf(system.PatchOf(i));
    emittance.push_back(material.emittance);
    reflectance.push_back(material.reflectance);
  }
  return SolveDense(system, emittance, reflectance);
}

DenseLight SolveDense(const DenseSystem& system, std::span<const Rgb> emittance,
                      std::span<const Rgb> reflectance) {
  PENUMBRA_CHECK(emittance.size() == system.size() && reflectance.size() == system.size());
  const auto n = static_cast<Eigen::Index>(system.size());
  DenseLight light;
  light.irradiance.assign(system.size(), Rgb::Zero());
  light.radiosity.assign(system.size(), Rgb::Zero());
  const auto column = [&](std::span<const Rgb> values, int channel) {
    Eigen::VectorXd of(n);
    for (Eigen::Index i = 0; i < n; ++i) of[i] = values[static_cast<std::size_t>(i)][channel];
    return of;
  };
  // Channels with equal reflectances share the factorisation.
  Eigen::VectorXd factored;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors;
  for (int channel = 0; channel < 3 && n > 0; ++channel) {
    const Eigen::VectorXd rho = column(reflectance, channel);
    if (channel == 0 || rho != factored) {
      Eigen::MatrixXd matrix = -(rho.asDiagonal() * system.transport);
      matrix.diagonal().array() += 1;
      factors.compute(std::move(matrix));
      factored = rho;
    }
    const Eigen::VectorXd radiosity = factors.solve(column(emittance, channel));
    const Eigen::VectorXd irradiance = system.transport * radiosity;
    for (Eigen::Index i = 0; i < n; ++i) {
      light.radiosity[static_cast<std::size_t>(i)][channel] = radiosity[i];
      light.irradiance[static_cast<std::size_t>(i)][channel] = irradiance[i];
    }
  }
  return light;
}

Rgb DenseIrradiance(const DenseSystem& system, const DenseLight& light, const PatchVisibility& visibility,
                    PatchId patch, const ReceiverPoint& at) {
  std::vector<double> row(system.size());
  AddTransport(system, visibility, patch, at, row);
  Rgb irradiance = Rgb::Zero();
  for (std::size_t i = 0; i < row.size(); ++i) irradiance += row[i] * light.radiosity[i];
  return irradiance;
}

RadiositySolution ToRadiositySolution(const DenseSystem& system, const DenseLight& light) {
  RadiositySolution solution;
  solution.forest = system.forest;
  solution.irradiance.assign(system.forest.size(), Rgb::Zero());
  solution.radiosity.assign(system.forest.size(), Rgb::Zero());
  for (std::size_t i = 0; i < system.size(); ++i) {
    const ElementId leaf = system.elements[system.element_of_unknown[i]].leaf;
    const double share = system.Weight(i) / system.forest[leaf].area;
    solution.irradiance[leaf] += share * light.irradiance[i];
    solution.radiosity[leaf] += share * light.radiosity[i];
  }
  Average(solution);
  return solution;
}

DenseSolver::DenseSolver(const Scene& scene, const PatchVisibility& visibility, const DenseOptions& options,
                         const ExecutionContext& context)
    : visibility_(visibility) {
  const ElementForest forest = UniformForest(scene, options.divisions);
  const std::size_t unknowns = CountUnknowns(forest, options.degree);
  if (unknowns > kMostDenseUnknowns)
    throw InputError(scene.name + ": error: the dense solver would have " + std::to_string(unknowns) +
                     " unknowns and can take " + std::to_string(kMostDenseUnknowns) +
                     "; ask for fewer divisions or a basis of lower degree");
  auto system = std::make_shared<const DenseSystem>(AssembleDense(forest, visibility, options, context));
  solved_ = !context.Cancelled();
  if (!solved_) {
    solution_.forest = ElementForest(scene);
    PushPull dark(solution_);  // sets the light of the elements to emittance only
    return;
  }
  solution_ = ToRadiositySolution(*system, SolveDense(*system));
  report_.dense = {system->size(), MeasureClosure(*system), system->form_factor_error};
  report_.interactions = CountPairs(*system, visibility);
  if (options.keep_matrix) system_ = std::move(system);
}

DenseSolver::DenseSolver(const DenseSolver& from, const Scene& other)
    : visibility_(from.visibility_),
      system_(from.system_),
      solved_(true),
      solution_(ToRadiositySolution(*system_, SolveDense(*system_, other))),
      report_(from.report_),
      seen_from_leaves_(from.seen_from_leaves_) {
  solution_.forest = solution_.forest.Of(other);
}

std::unique_ptr<LightSolver> DenseSolver::LitAs(const Scene& other, const ExecutionContext& context) const {
  if (!system_ || context.Cancelled()) return nullptr;
  return std::unique_ptr<LightSolver>(new DenseSolver(*this, other));
}

void DenseSolver::ReplaceLight(std::span<const Rgb> element, std::span<const Rgb> fragment) {
  ReplaceIrradiance(element, fragment, solution_);
}

bool DenseSolver::SetLight(std::span<const Rgb>, std::vector<Fragment>, const ExecutionContext&) {
  PENUMBRA_CHECK(TakesLight());
  return false;
}

std::shared_ptr<const LeafVisibility> DenseSolver::SeenFromLeaves(const ExecutionContext& context) {
  return seen_from_leaves_.Get(solution_.forest, visibility_, context);
}

LightSolverRegistry::Method DenseSolverMethod() {
  return {"dense",
          "the linear system of a uniform mesh with exact form factors, solved directly: a reference for "
          "small scenes",
          {"basis", "divisions"},
          [](const SolverScene& in, const LightSolverOptions& options, const ExecutionContext& context) {
            if (in.goes_on_from) return std::unique_ptr<DenseSolver>();
            return std::make_unique<DenseSolver>(in.scene, in.pairs(context), options.dense, context);
          }};
}

}  // namespace penumbra
