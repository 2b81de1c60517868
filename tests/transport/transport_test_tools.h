// tests/transport/transport_test_tools.h
//
// One-line ways to irradiance for the tests of transport.

#pragma once

#include <gtest/gtest.h>

#include "solver/transport/hierarchical_solver.h"
#include "solver/transport/point_irradiance.h"
#include "solver/transport/source_set.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {

inline ReceiverPoint Receiver(const Vec3& position, const Vec3& normal, const Vec3& approach = Vec3::Zero()) {
  ReceiverPoint at;
  at.position = position;
  at.normal = normal.normalized();
  at.approach = approach;
  return at;
}

// What the emitters send to a point, seen with all patches as candidates.
inline PointIrradianceResult Direct(const Scene& scene, const ReceiverPoint& at) {
  const SourceSet sources = SourceSet::Emitters(scene);
  const PatchVisibility visibility;
  return PointIrradiance(scene, visibility, sources).Anywhere(at);
}

inline RadiositySolution Solved(const Scene& scene, double eps, double min_area = 1e-5) {
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.eps = eps;
  options.min_area = min_area;
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve(ExecutionContext());
  EXPECT_TRUE(solver.Converged());
  return std::move(solver).TakeSolution();
}

}  // namespace penumbra::scene_test
