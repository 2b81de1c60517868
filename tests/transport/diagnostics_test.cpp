// What tells whether scenes and links are sound.

#include "solver/transport/solvers/diagnostics.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/transport/points/free_area.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// In a closed box form factors add up to 1 and links agree with their counterparts, the better the finer they
// are; what leaves an open box is what its missing wall would have received.
TEST(DiagnoseLinks, ClosureOfBoxes) {
  Scene box;
  const std::int32_t wall = AddMaterial(box, 0.5, 1);
  AddBox(box, Vec3::Zero(), Vec3::Ones(), true, wall);
  double last = 1;
  for (const double eps : {0.5, 0.1}) {
    const LinkDiagnostics links = DiagnoseLinks(Solved(box, eps));
    double worst = 0;
    for (const double closure : links.closure) worst = std::max(worst, std::abs(closure - 1));
    EXPECT_EQ(worst, std::max(links.closure_max - 1, 1 - links.closure_min));
    EXPECT_EQ(links.patch_pairs, 15U);
    std::printf("eps %.2f: closure off by %.2g, patches not reciprocal by %.2g at worst, links by %.2g\n",
                eps, worst, links.patch_reciprocity, links.link_reciprocity);
    EXPECT_LE(links.patch_reciprocity, 2e-5);
    EXPECT_LT(worst, last);
    last = worst;
  }
  // Gauss points near common edges, 4 x 16 of them to an element, leave some millionths.
  EXPECT_LE(last, 2e-5);

  Scene open = box;
  open.patches.erase(open.patches.begin() + 1);
  const LinkDiagnostics links = DiagnoseLinks(Solved(open, 0.2));
  // Opposite squares of a cube see 0.1998 of each other, neighbours 0.2000.
  for (const double closure : links.closure) EXPECT_NEAR(closure, 0.8, 2e-3);
}

// What stands on a floor covers its foot, and of itself the side that lies on the floor sees nothing at all.
TEST(FreeAreas, OfAFloorUnderFurniture) {
  Scene scene;
  AddMaterial(scene, 0.5, 1);
  AddBox(scene, Vec3::Zero(), {4, 4, 3}, true, 0);
  AddBox(scene, {1, 1, 0}, {1.5, 2, 1}, false, 0);          // patches 6 to 11, the first is its bottom
  AddBox(scene, {2.5, 2.5, 0}, {2.6, 2.6, 0.7}, false, 0);  // 12 to 17
  const std::vector<double> free_area = FreeAreas(scene);
  EXPECT_NEAR(free_area[0], 16 - 0.5 - 0.01, 1e-9);
  EXPECT_EQ(free_area[6], 0);
  EXPECT_EQ(free_area[12], 0);
  for (const std::size_t p : {1, 2, 7, 8, 13, 14}) EXPECT_EQ(free_area[p], scene.patches[p].area) << p;
  // In the open an even light fills the hemisphere of no front: a lone square sees nothing.
  Scene square = scene;
  square.patches.resize(1);
  EXPECT_EQ(FreeAreas(square), std::vector<double>{0});
}

// Links that are lit from one side only are found: a form factor that is changed breaks reciprocity by as
// much.
TEST(DiagnoseLinks, FindsAPairThatDisagrees) {
  Scene box;
  AddMaterial(box, 0.5, 1);
  AddBox(box, Vec3::Zero(), Vec3::Ones(), true, 0);
  RadiositySolution solution = Solved(box, 10);
  const LinkDiagnostics before = DiagnoseLinks(solution);
  ASSERT_GT(before.link_pairs, 0U);
  solution.links.links[3].form_factor += 0.25;
  const LinkDiagnostics after = DiagnoseLinks(solution);
  EXPECT_NEAR(after.link_reciprocity, 0.25, before.link_reciprocity + 1e-12);
  EXPECT_NEAR(after.patch_reciprocity, 0.25, before.patch_reciprocity + 1e-12);
  EXPECT_GT(after.closure_max, 1.2);
}

// Of a closed room nothing escapes; of a lone square everything does; a box turned inside out sees nothing
// but backs, and its faces are told.
TEST(DiagnoseViews, OpenAndReversed) {
  Scene room;
  AddMaterial(room, 0.5, 1);
  AddBox(room, Vec3::Zero(), {4, 3, 2}, true, 0);
  for (std::size_t p = 0; p < room.patches.size(); ++p)
    room.patches[p].faces = {static_cast<std::int32_t>(p)};
  EXPECT_EQ(DiagnoseViews(room).escaping, 0);
  EXPECT_TRUE(DiagnoseViews(room).reversed_faces.empty());

  Scene square = room;
  square.patches.resize(1);
  EXPECT_EQ(DiagnoseViews(square).escaping, 1);
  EXPECT_TRUE(DiagnoseViews(square).reversed_faces.empty());

  Scene reversed = room;
  Patch& wall = reversed.patches[2];
  const std::vector<Vec3> back(wall.Vertices().rbegin(), wall.Vertices().rend());
  wall = MakePatch(back, 0, 0, {2});
  EXPECT_TRUE(DiagnoseViews(reversed).reversed_faces.empty()) << "outside it sees the sky";
  AddBox(reversed, {-1, -1, -1}, {5, 4, 3}, false, 0);
  EXPECT_EQ(DiagnoseViews(reversed).reversed_faces, std::vector<std::int32_t>({2}));
  EXPECT_EQ(DiagnoseViews(Scene()).rays, 0U);
}

// What stands on a face hides it, and does not make it a reversed one: of a tower of two blocks every face is
// right.
TEST(DiagnoseViews, CoveredFacesAreNotReversed) {
  Scene room;
  AddMaterial(room, 0.5, 1);
  AddBox(room, Vec3::Zero(), {4, 3, 2}, true, 0);
  AddBox(room, {1, 1, 0}, {2, 2, 0.5}, false, 0);
  AddBox(room, {1, 1, 0.5}, {2, 2, 1}, false, 0);
  for (std::size_t p = 0; p < room.patches.size(); ++p)
    room.patches[p].faces = {static_cast<std::int32_t>(p)};
  EXPECT_TRUE(DiagnoseViews(room).reversed_faces.empty());
}

// In a room that is turned inside out the lamp, which is right, lights backs alone; in one that is not, it
// lights fronts, and a box lit from outside has fronts as well.
TEST(FindLitSides, TurnedRooms) {
  for (const bool turned : {false, true}) {
    Scene room;
    AddMaterial(room, 0.5, 0);
    AddMaterial(room, 0, 10);
    AddBox(room, Vec3::Zero(), {4, 3, 2}, !turned, 0);
    room.patches.push_back(
        MakePatch(std::vector<Vec3>{{1, 2, 1.9}, {2, 2, 1.9}, {2, 1, 1.9}, {1, 1, 1.9}}, 1, 0, {6}));
    const LitSides sides = FindLitSides(room);
    EXPECT_EQ(sides.TurnedInsideOut(), turned);
    // The ceiling is lit from the lamp by the others alone; nobody emits into the gap above the lamp.
    EXPECT_NEAR(turned ? sides.back : sides.front, 2 * (4 * 3 + 4 * 2 + 3 * 2) - 4 * 3, 1e-12);
    EXPECT_EQ(turned ? sides.front : sides.back, 0);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
