// Grids of points on working planes: where they lie, and over what.

#include "solver/scene/work_grid.h"

#include <gtest/gtest.h>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// A scene of these faces, each a patch where it has four vertices.
Scene FloorScene(const std::vector<Polygon3>& polygons) {
  Scene scene;
  scene.materials.emplace_back();
  scene.objects.push_back({"floor", {}});
  for (const Polygon3& polygon : polygons) {
    const auto number = static_cast<std::int32_t>(scene.faces.size());
    scene.faces.push_back({polygon, 0, 0});
    if (polygon.size() == 4) scene.patches.push_back(MakePatch(polygon, 0, 0, {number}));
  }
  return scene;
}

// Points lie at the spacing, centred over the faces, at the height above them.
TEST(WorkGrid, IsCentredAtItsSpacing) {
  const Scene scene = FloorScene({{{1, 2, 0.5}, {5, 2, 0.5}, {5, 4.3, 0.5}, {1, 4.3, 0.5}}});
  const WorkGrid grid = GridOverFaces(scene, std::vector<std::int32_t>{0}, 0.85, 0.5);
  EXPECT_EQ(grid.columns, 8);
  EXPECT_EQ(grid.rows, 4);
  ASSERT_EQ(grid.points.size(), 32u);
  Vec3 mean = Vec3::Zero();
  for (const GridPoint& point : grid.points) {
    EXPECT_DOUBLE_EQ(point.position.z(), 1.35);
    mean += point.position / 32;
  }
  EXPECT_NEAR(mean.x(), 3, 1e-12);
  EXPECT_NEAR(mean.y(), 3.15, 1e-12);
  EXPECT_NEAR(grid.points[1].position.x() - grid.points[0].position.x(), 0.5, 1e-12);
  EXPECT_NEAR(grid.points[8].position.y() - grid.points[0].position.y(), 0.5, 1e-12);
}

// The share of a concave face's bounding box that has points tends to the share of its area; the face may
// slope, and then the points do. What looks down has no points, and of two storeys the upper has them.
TEST(WorkGrid, LiesOverFacesThatLookUp) {
  const Scene scene = FloorScene({{{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}},
                                  {{0, 0, 1}, {1, 0, 2}, {1, 1, 2}, {0, 1, 1}},
                                  {{0, 0, 5}, {0, 1, 5}, {1, 1, 5}, {1, 0, 5}}});
  const WorkGrid concave = GridOverFaces(scene, std::vector<std::int32_t>{0}, 0, 0.02);
  EXPECT_NEAR(static_cast<double>(concave.points.size()) / (concave.columns * concave.rows), 4.0 / 6, 0.01);
  for (const GridPoint& point : concave.points) EXPECT_TRUE(point.position.x() < 1 || point.position.y() < 1);
  const WorkGrid storeys = GridOverFaces(scene, std::vector<std::int32_t>{0, 1, 2}, 0, 0.1);
  for (const GridPoint& point : storeys.points) {
    const bool under_slope = point.position.x() < 1 && point.position.y() < 1;
    EXPECT_NEAR(point.position.z(), under_slope ? 1 + point.position.x() : 0, 1e-12);
  }
  EXPECT_THROW(GridOverFaces(scene, std::vector<std::int32_t>{2}, 0, 0.1), InputError);
  EXPECT_THROW(GridOverFaces(scene, std::vector<std::int32_t>{0}, 0, 1e-6), InputError);
}

// A floor that lies on its side tells which way it looks, since its file has another axis upwards; a ceiling
// does not.
TEST(WorkGrid, TellsOfAFloorOnItsSide) {
  const Scene scene = FloorScene(
      {{{0, 0, 0}, {0, 0, 3}, {3, 0, 3}, {3, 0, 0}}, {{0, 0, 5}, {0, 1, 5}, {1, 1, 5}, {1, 0, 5}}});
  const auto why = [&](std::int32_t face) -> std::string {
    try {
      GridOverFaces(scene, std::vector<std::int32_t>{face}, 0, 1);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(why(0).find("it looks along +y: if that should be up"), std::string::npos) << why(0);
  EXPECT_EQ(why(1), "nothing of it looks up; give another --object, or --plane z=Z");
}

// A plane has points over the whole extent; a spacing larger than the extent leaves one in the middle.
TEST(WorkGrid, LiesInAPlane) {
  const Scene scene = FloorScene({{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}}});
  EXPECT_EQ(GridAtHeight(scene, 1.5, 1).points.size(), 6u);
  const WorkGrid one = GridAtHeight(scene, 1.5, 10);
  ASSERT_EQ(one.points.size(), 1u);
  EXPECT_EQ(one.points[0].position, Vec3(1.5, 1, 1.5));
}

}  // namespace
}  // namespace penumbra
