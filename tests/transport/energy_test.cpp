// Energy where faces lie on each other: what looks the other way neither lights nor blocks.

#include "solver/transport/solvers/energy.h"

#include <gtest/gtest.h>

#include "solver/transport/solvers/hierarchical_solver.h"

namespace penumbra {
namespace {

Scene LightWithBlackBack(bool with_plate) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[0].reflectance = scene.materials[1].reflectance = Rgb::Zero();
  scene.materials[0].emittance = Rgb::Constant(100);
  const std::vector<Vec3> light = {{0, 2, 5}, {0, 3, 5}, {3, 3, 5}, {3, 2, 5}};
  scene.patches.push_back(MakePatch(light, 0, 0, {}));
  scene.patches.push_back(MakePatch(std::vector<Vec3>(light.rbegin(), light.rend()), 1, 0, {}));
  if (with_plate)
    scene.patches.push_back(
        MakePatch(std::vector<Vec3>{{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}}, 1, 0, {}));
  return scene;
}

EnergyBalance Balance(const Scene& scene, double eps = 0.1) {
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.eps = eps;  // [W/m^2]
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve({});
  return MeasureEnergy(solver.solution());
}

// A light in empty space, black behind: all of its 900 W (3 m^2, 100 W/m^2, three channels) escape.
TEST(MeasureEnergy, ACoincidentBackNeitherBlocksNorAbsorbs) {
  const EnergyBalance alone = Balance(LightWithBlackBack(false));
  EXPECT_DOUBLE_EQ(alone.emitted, 900);
  EXPECT_NEAR(alone.escaped, 900, 1e-6);
  EXPECT_NEAR(alone.absorbed, 0, 1e-6);
  EXPECT_LE(Balance(LightWithBlackBack(true)).relative_imbalance, 1e-3);
}

// A floor under a blind of 16 slats, whose stripes are as far apart as the points of a coarse leaf's rule:
// the light still adds up, at an eps at which a leaf is wider than a stripe.
TEST(MeasureEnergy, StripesOfABlindAreNotMissed) {
  Scene scene;
  scene.materials.resize(3);
  scene.materials[0].reflectance = Rgb::Constant(0.5);
  scene.materials[1].reflectance = scene.materials[2].reflectance = Rgb::Zero();
  scene.materials[2].emittance = Rgb::Constant(100);
  const auto add = [&](const std::vector<Vec3>& polygon, int material) {
    scene.patches.push_back(MakePatch(polygon, material, 0, {}));
  };
  add({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, 0);
  add({{-0.5, 0.5, 3}, {0.5, 0.5, 3}, {0.5, -0.5, 3}, {-0.5, -0.5, 3}}, 2);
  for (int i = 0; i < 16; ++i) {
    const double x = -2 + 0.25 * i;
    add({{x, -2, 1}, {x + 0.2, -2, 1}, {x + 0.2, 2, 1}, {x, 2, 1}}, 1);
  }
  EXPECT_LE(Balance(scene, 0.18).relative_imbalance, 1e-3);
}

}  // namespace
}  // namespace penumbra
