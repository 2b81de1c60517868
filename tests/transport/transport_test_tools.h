// tests/transport/transport_test_tools.h
//
// One-line ways to irradiance for the tests of transport.

#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/hierarchical_solver.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/exact/occlusion_methods.h"
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
inline PointIrradianceResult Direct(const Scene& scene, const ReceiverPoint& at,
                                    const OcclusionMethod* method = nullptr) {
  const PatchVisibility unused;
  PointIrradianceOptions options;
  options.method = method;
  return PointIrradiance(scene, unused, SourceSet::Emitters(scene), options).Anywhere(at);
}

// The oracles of the library; tests may add others to the registry.
inline const std::vector<std::string> kOracles = {"transport", "visibility", "gradient", "thesis"};

// All exact ways to a visible form factor by name, and null: the default.
struct NamedMethod {
  std::string name;
  std::unique_ptr<const OcclusionMethod> method;
};
inline std::vector<NamedMethod> ExactMethods() {
  std::vector<NamedMethod> methods;
  methods.push_back({"auto", nullptr});
  for (const std::string& name : OcclusionMethods().Names())
    if (name != "sampled") methods.push_back({name, OcclusionMethods().Make(name, {})});
  return methods;
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
