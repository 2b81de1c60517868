// solver/transport/solvers/rayrad_solver.h

#pragma once

#include <array>
#include <vector>

#include "solver/transport/solvers/shooting_solver.h"

namespace penumbra {

// Progressive refinement with light at the vertices of the elements (Wallace, Elmquist and Haines 1989;
// RayRad in Ashdown 1994, 6.10): rays run from each vertex to random points of the shooting patch, each for a
// disk, by the printed formula (RayFormula::kDisks). An element has the mean of its vertices. A vertex counts
// once in a shot however many elements share it; as printed, it received the light once for each of them.
class RayradSolver final : public ShootingSolver {
 public:
  RayradSolver(const Scene& scene, const PatchVisibility& visibility, const UniformOptions& options,
               const ExecutionContext& context);

  std::size_t VertexCount() const { return vertices_.size(); }

 private:
  struct Vertex {
    PatchId patch = kNoPatch;
    Vec3 position = Vec3::Zero();
  };
  std::vector<double> FormFactorsOf(PatchId shooter, const ExecutionContext& context) const override;

  std::vector<Vertex> vertices_;           // patch by patch; patches share none
  std::vector<std::size_t> first_vertex_;  // of each patch, and one past the last
  std::vector<std::array<std::int32_t, 4>>
      corner_;  // of each leaf, in vertices_; -1: a triangle has no fourth
};

LightSolverRegistry::Method RayradSolverMethod();

}  // namespace penumbra
