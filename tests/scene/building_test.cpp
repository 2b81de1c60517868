#include "solver/scene/building.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "solver/base/check.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

Scene Load(int rows, int columns) {
  return *LoadBuiltinScene("building-" + std::to_string(rows) + "x" + std::to_string(columns), {});
}

double VolumeInside(const Scene& scene, std::string_view kind) {
  double sum = 0;
  for (const Object& object : scene.objects)
    if (std::string_view(object.name).starts_with(kind))
      for (const std::int32_t face : object.faces) {
        const Polygon3& polygon = scene.faces[static_cast<std::size_t>(face)].vertices;
        sum += VectorArea(polygon).dot(polygon[0]) / 3;
      }
  return sum;
}

// A room has six faces and 48 of furniture and lamp, a doorway four; walls around doorways become three or
// five patches. No two faces lie on each other, nothing had to be mended.
TEST(Building, CountsOfFaces) {
  for (const auto& [rows, columns] : {std::pair(1, 1), std::pair(1, 3), std::pair(5, 5)}) {
    const Scene scene = Load(rows, columns);
    const int rooms = rows * columns, doors = rows * (columns - 1) + columns * (rows - 1);
    EXPECT_EQ(scene.faces.size(), static_cast<std::size_t>(54 * rooms + 4 * doors));
    EXPECT_EQ(scene.patches.size(), static_cast<std::size_t>(54 * rooms + (4 + 2 * 2) * doors));
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front();
    EXPECT_FALSE(scene.cameras.empty());
  }
}

// Every piece of furniture and every lamp is closed and looks outwards; rooms and doorways together enclose
// their volume from inside.
TEST(Building, IsClosed) {
  const Scene scene = Load(3, 4);
  Vec3 shell = Vec3::Zero();
  for (const Object& object : scene.objects) {
    Vec3 sum = Vec3::Zero();
    for (const std::int32_t face : object.faces)
      sum += VectorArea(scene.faces[static_cast<std::size_t>(face)].vertices);
    if (object.name.starts_with("room") || object.name.starts_with("door")) {
      shell += sum;
    } else {
      EXPECT_LE(sum.norm(), 1e-12) << object.name;
    }
  }
  EXPECT_LE(shell.norm(), 1e-12);
  const double doors = 3 * 3 + 2 * 4;
  EXPECT_NEAR(VolumeInside(scene, "room") + VolumeInside(scene, "door"),
              -(12 * 4 * 5 * 2.7 + doors * 0.2 * 0.9 * 2.1), 1e-9);
  EXPECT_GT(VolumeInside(scene, "table"), 0);
  EXPECT_GT(VolumeInside(scene, "lamp"), 0);
}

// Furniture stays inside its room, below the lamps.
TEST(Building, FurnitureStaysInItsRoom) {
  const Scene scene = Load(4, 4);
  for (const Object& object : scene.objects) {
    int row = 0, column = 0;
    if (object.name.starts_with("door") ||
        std::sscanf(object.name.c_str(), "%*[a-z]-%d-%d", &row, &column) != 2)
      continue;
    const double x = 4.2 * (column - 1), y = 5.2 * (row - 1);
    for (const std::int32_t face : object.faces)
      for (const Vec3& v : scene.faces[static_cast<std::size_t>(face)].vertices) {
        EXPECT_GE(v.x(), x - 1e-12) << object.name;
        EXPECT_LE(v.x(), x + 4 + 1e-12) << object.name;
        EXPECT_GE(v.y(), y - 1e-12) << object.name;
        EXPECT_LE(v.y(), y + 5 + 1e-12) << object.name;
        EXPECT_GE(v.z(), 0) << object.name;
        EXPECT_LE(v.z(), 2.7) << object.name;
      }
  }
}

// A room is the same in every building, and no two rooms are alike.
TEST(Building, RoomsDependOnTheirNumberAlone) {
  const Scene small = Load(1, 2), large = Load(3, 3);
  const auto chair = [](const Scene& scene, const std::string& name) {
    for (const Object& object : scene.objects)
      if (object.name == name)
        return scene.faces[static_cast<std::size_t>(object.faces.front())].vertices.front();
    ADD_FAILURE() << name;
    return Vec3(Vec3::Zero());
  };
  EXPECT_EQ(chair(small, "chair-1-2"), chair(large, "chair-1-2"));
  EXPECT_NE(Vec3(chair(large, "chair-1-1") + Vec3(4.2, 0, 0)), chair(large, "chair-1-2"));
}

TEST(Building, NamesThatAreNoSizeAreRefused) {
  EXPECT_FALSE(BuildingNamed("office").has_value());
  for (const char* name : {"building-", "building-3", "building-3x", "building-0x1", "building-1x33",
                           "building-2x2x2", "building-2 x2", "building--1x1", "building-99999999999x1"})
    EXPECT_THROW(BuildingNamed(name), InputError) << name;
  EXPECT_EQ(BuildingNamed("building-32x7")->rows, 32);
  EXPECT_EQ(BuildingNamed("building-32x7")->columns, 7);
}

}  // namespace
}  // namespace penumbra
