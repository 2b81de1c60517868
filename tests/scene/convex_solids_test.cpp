// Convex solids are found among patches, and nothing else is taken for one.

#include "solver/scene/convex_solids.h"

#include <gtest/gtest.h>

#include "solver/scene/named_scene.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// Takes away a patch, by its number.
void Remove(Scene& scene, int patch) { scene.patches.erase(scene.patches.begin() + patch); }

int Missing(const ConvexSolid& solid) {
  int missing = 0;
  for (const ConvexSolid::Side& side : solid.sides) missing += side.patch == kNoPatch ? 1 : 0;
  return missing;
}

TEST(ConvexSolids, BoxesWithAndWithoutSides) {
  for (const int removed : {0, 1, 2}) {
    Scene scene;
    AddBox(scene, {1, 2, 0}, {2, 3, 5}, false, AddMaterial(scene, 0.5, 0));
    for (int i = 0; i < removed; ++i) Remove(scene, 0);  // bottom, then top
    FindConvexSolids(scene);
    ASSERT_EQ(scene.solids.size(), 1U);
    EXPECT_EQ(scene.solids[0].sides.size(), 6U);
    EXPECT_EQ(scene.solids[0].corners.size(), 8U);
    EXPECT_EQ(Missing(scene.solids[0]), removed);
    for (std::size_t p = 0; p < scene.patches.size(); ++p)
      EXPECT_EQ(scene.SolidOf(static_cast<PatchId>(p)), 0);
    for (const ConvexSolid::Side& side : scene.solids[0].sides)
      for (const Vec3& corner : scene.solids[0].corners)
        EXPECT_LE(side.normal.dot(corner - scene.solids[0].corners[static_cast<std::size_t>(side.corner[0])]),
                  1e-15);
  }
}

TEST(ConvexSolids, TurnedFarAndSmall) {
  Random random(20260101);
  for (int i = 0; i < 200; ++i) {
    Scene scene;
    AddBox(scene, {0, 0, 0}, {1, random.LogUniform(1e-2, 1), random.LogUniform(1e-2, 1)}, false,
           AddMaterial(scene, 0.5, 0));
    const Motion motion = RandomMotion(random, 1000);
    scene = Mapped(scene, motion);
    EXPECT_EQ(scene.solids.size(), 1U) << i;
  }
}

// A room seen from inside, a box that lost two sides which meet, and a notched block are no convex solids.
TEST(ConvexSolids, WhatIsNone) {
  Scene room;
  AddBox(room, {0, 0, 0}, {1, 1, 1}, true, AddMaterial(room, 0.5, 0));
  FindConvexSolids(room);
  EXPECT_TRUE(room.solids.empty());
  EXPECT_EQ(room.SolidOf(0), kNoSolid);

  Scene open;
  AddBox(open, {0, 0, 0}, {1, 1, 1}, false, AddMaterial(open, 0.5, 0));
  Remove(open, 2);
  Remove(open, 0);
  FindConvexSolids(open);
  EXPECT_TRUE(open.solids.empty());

  // Two boxes that stand side by side without the sides between them, one higher than the other.
  Scene step;
  AddBox(step, {0, 0, 0}, {1, 1, 1}, false, AddMaterial(step, 0.5, 0));
  AddBox(step, {1, 0, 0}, {2, 1, 2}, false, 0);
  FindConvexSolids(step);
  EXPECT_EQ(step.solids.size(), 2U);
  Remove(step, 10);
  Remove(step, 5);
  FindConvexSolids(step);
  for (const ConvexSolid& solid : step.solids)
    for (const ConvexSolid::Side& side : solid.sides)
      for (const Vec3& corner : solid.corners)
        EXPECT_LE(side.normal.dot(corner - solid.corners[static_cast<std::size_t>(side.corner[0])]), 1e-15);
}

// All sides of a thing in one plane have all corners behind them, though its outline may bend inwards.
TEST(ConvexSolids, FlatThingsAreNone) {
  const std::vector<Polygon3> bent = {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                      {{0, 1, 0}, {2, 1, 0}, {1, 2, 0}, {0, 2, 0}}};
  for (const bool with_backs : {false, true}) {
    Scene scene;
    AddMaterial(scene, 0.5, 0);
    for (const Polygon3& tile : bent) Add(scene, tile, 0);
    // Backs of another partition, so that no edge inside is shared by four.
    if (with_backs) Add(scene, {{0, 0, 0}, {0, 2, 0}, {1, 2, 0}, {2, 1, 0}}, 0);
    if (with_backs) Add(scene, {{0, 0, 0}, {2, 1, 0}, {2, 0, 0}}, 0);
    FindConvexSolids(scene);
    EXPECT_TRUE(scene.solids.empty());
  }
}

TEST(ConvexSolids, FrontAndBackOfASheet) {
  Scene scene;
  const Polygon3 sheet = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  Add(scene, sheet, AddMaterial(scene, 0.5, 0));
  Add(scene, Polygon3(sheet.rbegin(), sheet.rend()), 0);
  FindConvexSolids(scene);
  ASSERT_EQ(scene.solids.size(), 1U);
  EXPECT_EQ(scene.solids[0].sides.size(), 2U);
}

// Every block of the built-in scenes, most of which stand without their feet.
TEST(ConvexSolids, OfTheBuiltInScenes) {
  const auto solids = [](const char* name) { return ReadNamedScene(name, {}).solids.size(); };
  EXPECT_EQ(solids("cornell"), 2U);
  EXPECT_EQ(solids("floating-cube"), 1U);
  EXPECT_GE(solids("office"), 10U);
  EXPECT_EQ(solids("furnace"), 0U);
}

}  // namespace
}  // namespace penumbra::scene_test
