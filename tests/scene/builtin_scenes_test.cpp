#include "solver/scene/builtin_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

Scene Load(const std::string& name) {
  std::optional<Scene> scene = LoadBuiltinScene(name, {});
  EXPECT_TRUE(scene.has_value()) << name;
  return scene ? std::move(*scene) : Scene();
}

// Every scene loads, has light, names its cameras, and warns of nothing but faces cut where others lie in
// them.
TEST(BuiltinScenes, AllLoad) {
  for (const BuiltinScene& builtin : BuiltinScenes()) {
    const Scene scene = Load(builtin.name);
    EXPECT_FALSE(scene.patches.empty()) << builtin.name;
    EXPECT_FALSE(builtin.description.empty()) << builtin.name;
    EXPECT_EQ(scene.cameras.size(), builtin.cameras.size()) << builtin.name;
    EXPECT_TRUE(std::any_of(scene.materials.begin(), scene.materials.end(),
                            [](const Material& material) { return (material.emittance > 0).any(); }));
    for (const std::string& warning : scene.warnings)
      EXPECT_NE(warning.find("in the same plane"), std::string::npos) << warning;
    for (const Face& face : scene.faces) EXPECT_GE(face.vertices.size(), 3U) << builtin.name;
    if (builtin.name != "furnace") {
      EXPECT_GE(scene.cameras.size(), 3U) << builtin.name;
    }
  }
  EXPECT_FALSE(LoadBuiltinScene("no such scene", {}).has_value());
}

// The office is about sixty quadrilaterals (thesis 7.1), and its room is closed.
TEST(BuiltinScenes, OfficeIsSixtyQuadrilaterals) {
  const Scene scene = Load("office");
  EXPECT_GE(scene.faces.size(), 55U);
  EXPECT_LE(scene.faces.size(), 65U);
  for (const Face& face : scene.faces) EXPECT_EQ(face.vertices.size(), 4U);
  Vec3 room = Vec3::Zero();
  for (const Object& object : scene.objects)
    if (object.name == "room")
      for (const std::int32_t face : object.faces) room += VectorArea(scene.faces[face].vertices);
  EXPECT_LE(room.norm(), 1e-12);
}

// The furnace is a closed box whose front is inside: reflectance and emittance 1/2 make its radiosity 1.
TEST(BuiltinScenes, FurnaceIsClosed) {
  const Scene scene = Load("furnace");
  Vec3 sum = Vec3::Zero();
  double inwards = 0;
  const Vec3 centre = Vec3::Constant(0.5);
  for (const Patch& patch : scene.patches) {
    sum += patch.area * patch.normal;
    inwards += patch.area * patch.normal.dot(centre - patch.vertex[0]);
  }
  EXPECT_LE(sum.norm(), 1e-15);
  EXPECT_NEAR(inwards, 3, 1e-12);  // three times the volume
  for (const Material& material : scene.materials)
    EXPECT_TRUE((material.reflectance + material.emittance == 1).all()) << material.name;
}

// The light of the Cornell box looks down and lies in the ceiling's plane; its left wall is two triangles.
TEST(BuiltinScenes, CornellIsAsPublished) {
  const Scene scene = Load("cornell");
  int triangles = 0;
  for (const Patch& patch : scene.patches) {
    triangles += patch.size == 3 ? 1 : 0;
    if ((scene.materials[patch.material].emittance > 0).any()) {
      EXPECT_NEAR(patch.normal.z(), -1, 1e-12);
      EXPECT_NEAR(patch.vertex[0].z(), 0.5488, 1e-12);
      EXPECT_NEAR(patch.area, 0.130 * 0.105, 1e-12);
    }
  }
  EXPECT_EQ(triangles, 2);
}

}  // namespace
}  // namespace penumbra
