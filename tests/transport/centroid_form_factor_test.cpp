// The form factor between centroids.

#include <gtest/gtest.h>

#include <numbers>

#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// Two squares of side 0.1 at the distance 1 face each other: 0.01 / pi; a board between them hides one from
// the other.
TEST(CentroidFormFactor, BetweenFarSquares) {
  for (const bool blocked : {false, true}) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    Add(scene, {{0, 0, 0}, {0.1, 0, 0}, {0.1, 0.1, 0}, {0, 0.1, 0}}, 0);
    Add(scene, {{0, 0, 1}, {0, 0.1, 1}, {0.1, 0.1, 1}, {0.1, 0, 1}}, 0);
    if (blocked) Add(scene, {{-1, -1, 0.5}, {1, -1, 0.5}, {1, 1, 0.5}, {-1, 1, 0.5}}, 0);
    const auto part = [&](PatchId p) {
      const std::span<const Vec3> vertices = scene.patches[static_cast<std::size_t>(p)].Vertices();
      return AreaPart{p, {vertices.begin(), vertices.end()}};
    };
    const AreaPart from = part(0), to = part(1);
    const auto found =
        LinkFormFactorMethods().Make("centroids", {})->Between(scene, {&from, 1}, {&to, 1}, {});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->factor, blocked ? 0 : 0.01 / std::numbers::pi, 1e-15);
    EXPECT_LE(found->error, 1e-4);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
