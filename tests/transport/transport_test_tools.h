// tests/transport/transport_test_tools.h
//
// Functions by which tests of light transport compute irradiance in one line.

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

// Returns the direct irradiance from all emitters at a point, where every patch may block light.
inline PointIrradianceResult Direct(const Scene& scene, const ReceiverPoint& at,
                                    const OcclusionMethod* method = nullptr) {
  const PatchVisibility unused;
  PointIrradianceOptions options;
  options.method = method;
  return PointIrradiance(scene, unused, SourceSet::Emitters(scene), options).Anywhere(at);
}

// The names of the library's refinement oracles, which decide whether links between elements are accurate
// enough. Tests may add other refinement oracles to the registry.
inline const std::vector<std::string> kOracles = {"transport", "visibility", "gradient", "thesis"};

// Returns all exact methods for the form factor of the visible part of a source, with their names. The method
// named "auto" is null, which stands for the default method.
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
