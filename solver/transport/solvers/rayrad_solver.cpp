#include "solver/transport/solvers/rayrad_solver.h"

#include <unordered_map>

#include "solver/base/parallel.h"
#include "solver/transport/form_factors/source_rays.h"

namespace penumbra {
namespace {

constexpr std::size_t kVertexGrain = 16;

}  // namespace

RayradSolver::RayradSolver(const Scene& scene, const PatchVisibility& visibility,
                           const UniformOptions& options, const ExecutionContext& context)
    : ShootingSolver(scene, visibility, options) {
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const auto patch = static_cast<PatchId>(p);
    first_vertex_.push_back(vertices_.size());
    std::unordered_map<LatticePoint, std::int32_t, LatticePointHash> known;
    for (std::size_t i = FirstLeaf(patch); i < FirstLeaf(patch + 1); ++i) {
      const Element& element = forest()[leaves()[i]];
      std::array<std::int32_t, 4> corner = {-1, -1, -1, -1};
      for (std::size_t k = 0; k < element.Corners().size(); ++k) {
        const auto [at, fresh] =
            known.try_emplace(element.Corners()[k], static_cast<std::int32_t>(vertices_.size()));
        if (fresh) vertices_.push_back({patch, element.Vertices()[k]});
        corner[k] = at->second;
      }
      corner_.push_back(corner);
    }
  }
  first_vertex_.push_back(vertices_.size());
  if (!context.Cancelled()) SetReady();
}

std::vector<double> RayradSolver::FormFactorsOf(PatchId shooter, const ExecutionContext& context) const {
  const std::size_t wanted = options().form_factor_options.rays;
  const std::size_t rays = wanted > 0 ? wanted : kSourceRays;
  const std::uint64_t seed = options().form_factor_options.seed;
  const Patch& source = scene().patches[static_cast<std::size_t>(shooter)];
  std::vector<double> at_vertex(vertices_.size(), 0);
  for (const PatchPair& pair : visibility().SourcesOf(shooter)) {
    const auto receiver = static_cast<std::size_t>(pair.source);
    const std::size_t first = first_vertex_[receiver], count = first_vertex_[receiver + 1] - first;
    ParallelFor(count, kVertexGrain, [&](std::size_t k) {
      if (context.Cancelled()) return;
      const Vertex& vertex = vertices_[first + k];
      Random random(seed, ((first + k) << 24U) ^ static_cast<std::uint64_t>(shooter));
      const SightedPair sight{scene(),
                              pair.source,
                              shooter,
                              scene().patches[receiver].Vertices(),
                              source.Vertices(),
                              visibility().Blockers(pair),
                              rays,
                              random,
                              random};
      at_vertex[first + k] =
          PointFactorByRays(sight, vertex.position, rays, RayFormula::kDisks, &random).factor;
    });
  }
  std::vector<double> row(leaves().size(), 0);
  for (std::size_t i = 0; i < row.size(); ++i) {
    int corners = 0;
    for (const std::int32_t v : corner_[i]) {
      if (v < 0) continue;
      row[i] += at_vertex[static_cast<std::size_t>(v)];
      ++corners;
    }
    row[i] /= corners;
  }
  return row;
}

LightSolverRegistry::Method RayradSolverMethod() {
  return {"rayrad",
          "progressive refinement with light at vertices, by rays from them to the shooting patch (Wallace, "
          "Elmquist and Haines 1989)",
          {"divisions", "relative-cutoff", "rays", "shots", "ambient"},
          MakeUniformSolver<RayradSolver>};
}

}  // namespace penumbra
