// Bounce after bounce.

#include <gtest/gtest.h>

#include "solver/transport/solvers/bounce_solver.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// In a closed room of one material, exact form factors add up to 1: each step adds one term of the geometric
// series E (1 + rho + rho^2 + ...).
TEST(BounceSolver, AddsOneTermAStep) {
  constexpr double kEmittance = 3, kReflectance = 0.5, kTolerance = 1e-6;
  Scene scene;
  AddMaterial(scene, kReflectance, kEmittance);
  AddBox(scene, Vec3::Zero(), Vec3::Ones(), true, 0);
  const PatchVisibility visibility(scene);
  UniformOptions options;
  options.divisions = 1;
  options.form_factors = "exact";
  options.form_factor_options.factors_only = true;
  BounceSolver solver(scene, visibility, options, {});
  double expected = 0, term = kEmittance;
  while (solver.Next()) {
    expected += term;
    term *= kReflectance;
    ASSERT_TRUE(solver.Step(SolverStep::kIterate, {}));
    for (const Rgb& irradiance : solver.solution().irradiance)
      EXPECT_NEAR(irradiance[0], expected, kTolerance);
  }
  EXPECT_TRUE(solver.Converged());
  EXPECT_NEAR(expected, kEmittance / (1 - kReflectance), 1e-3);
}

}  // namespace
}  // namespace penumbra::scene_test
