// solver/transport/solvers/rayrad_solver.h

#pragma once

#include <array>
#include <vector>

#include "solver/transport/solvers/shooting_solver.h"

namespace penumbra {

// Progressive refinement with light at the vertices of the elements (Wallace, Elmquist and Haines 1989;
// RayRad in Ashdown 1994, 6.10): rays run from each vertex to random points of the shooting patch, and each
// ray stands for a disk (RayFormula::kDisks). The irradiance of an element is the mean of the irradiances at
// its vertices. A vertex receives the light of a shot once, even if several elements share the vertex; in the
// printed program RayRad, the vertex receives the light once for each element.
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

  std::vector<Vertex> vertices_;  // vertices of the elements, patch by patch; no two patches share a vertex
  // index of the first vertex of each patch; the last entry is the number of vertices
  std::vector<std::size_t> first_vertex_;
  // For each leaf, the indices of its corners in vertices_; the fourth index of a triangle is -1.
  std::vector<std::array<std::int32_t, 4>> corner_;
};

LightSolverRegistry::Method RayradSolverMethod();

}  // namespace penumbra
