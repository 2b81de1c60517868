// Files of modellers: the same room, as Assimp's own exporters write it, is the room of the OBJ file; units,
// axes, instances and what is left out; damaged files.

#include "solver/scene/assimp_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/scene/named_scene.h"
#include "solver/scene/scene_frame.h"
#include "test_paths.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string ForeignPath(const std::string& name) {
  return (fs::path(PENUMBRA_SOURCE_DIR) / "tests/foreign" / name).string();
}

std::string BytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

SceneOptions InFrame(const char* unit, UpAxis up) {
  SceneOptions options;
  options.unit = UnitNamed(unit);
  options.up = up;
  return options;
}

// Assimp writes coordinates as they stand in the OBJ file, whatever the format says of its axes and units.
SceneOptions AsWritten() { return InFrame("m", UpAxis::kZ); }

// The summed vector areas of all patches, by reflectance and emittance to 6 digits; fronts have signs.
std::map<std::string, std::pair<Vec3, double>> AreasByLook(const Scene& scene, bool with_materials) {
  std::map<std::string, std::pair<Vec3, double>> areas;
  for (const Patch& patch : scene.patches) {
    const Material& material = scene.materials[static_cast<std::size_t>(patch.material)];
    std::string look;
    for (int c = 0; c < 3 && with_materials; ++c)
      look += std::to_string(material.reflectance[c]) + " " + std::to_string(material.emittance[c]) + " ";
    auto& [vector, scalar] = areas.try_emplace(look, Vec3::Zero(), 0.0).first->second;
    vector += patch.normal * patch.area;
    scalar += patch.area;
  }
  return areas;
}

struct RoomFile {
  const char* name;
  bool has_materials, has_objects;
};

void PrintTo(const RoomFile& file, std::ostream* stream) { *stream << file.name; }

class RoomOfAssimp : public testing::TestWithParam<RoomFile> {};

// Patches, areas, fronts, reflectances and emitted power are those of the OBJ file. Triangles become the
// quadrilaterals again that they were made of.
TEST_P(RoomOfAssimp, IsTheRoomOfTheObj) {
  const Scene obj = ReadNamedScene(ForeignPath("room.obj"), {});
  const Scene scene = ReadNamedScene(ForeignPath(GetParam().name), AsWritten());
  EXPECT_EQ(scene.patches.size(), obj.patches.size());
  // Single precision has 24 bits.
  constexpr double kSingle = 1e-6;
  EXPECT_NEAR(scene.Diagonal(), obj.Diagonal(), kSingle * obj.Diagonal());
  const auto got = AreasByLook(scene, GetParam().has_materials),
             want = AreasByLook(obj, GetParam().has_materials);
  ASSERT_EQ(got.size(), want.size());
  for (const auto& [look, areas] : want) {
    ASSERT_TRUE(got.contains(look)) << look;
    EXPECT_LT((got.at(look).first - areas.first).norm(), 1e-5) << look;
    EXPECT_NEAR(got.at(look).second, areas.second, 1e-5) << look;
  }
  ASSERT_FALSE(scene.warnings.empty());
  EXPECT_THAT(scene.warnings[0], HasSubstr(": note: read as "));
  if (!GetParam().has_objects) return;
  std::vector<std::string> names;
  for (const Object& object : scene.objects) names.push_back(object.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"floor", "ceiling", "walls", "lamp", "shelf", "box"}));
}

INSTANTIATE_TEST_SUITE_P(Formats, RoomOfAssimp,
                         testing::Values(RoomFile{"room.glb", true, true}, RoomFile{"room.gltf", true, true},
                                         RoomFile{"room.dae", true, true}, RoomFile{"room.fbx", true, true},
                                         RoomFile{"room.3ds", true, false}, RoomFile{"room.x3d", true, false},
                                         RoomFile{"room.ply", false, false},
                                         RoomFile{"room.stl", false, false}));

class AssimpReaderTest : public scene_test::TestWithFolder {
 protected:
  // The message without the path.
  std::string ErrorOf(const std::string& path, const SceneOptions& options = {}) const {
    try {
      ReadNamedScene(path, options);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path + ": error: ")) << message;
      EXPECT_EQ(message.find('\n'), message.npos);
      return message.substr(std::min(path.size(), message.size()));
    }
    return "";
  }
};

// A glTF file with a triangle (0,0,0), (1,0,0), (0,1,0); the parts are put into its JSON.
std::string TriangleGltf(const std::string& nodes, const std::string& materials,
                         const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],"nodes":)" + nodes +
         R"(,"meshes":[{"name":"tri","primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":)" +
         materials +
         R"(,"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}])" +
         more + "}";
}
constexpr const char* kTwoNodes = R"([{"name":"a","mesh":0},{"name":"a","mesh":0,"translation":[0,0,-5]}])";
constexpr const char* kBrown = R"([{"name":"m","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0.125,1],
"metallicFactor":0},"emissiveFactor":[1,0.5,0.25],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":12}}}])";

// y is up in glTF: a triangle in the xy plane there stands upright, and looks along -y in the scene. Two
// instances are two objects with names of their own. Emission is colour times strength, in W/m^2.
TEST_F(AssimpReaderTest, GltfHasItsAxesInstancesAndStrength) {
  const Scene scene = ReadNamedScene(Write("a.gltf", TriangleGltf(kTwoNodes, kBrown)), {});
  ASSERT_EQ(scene.patches.size(), 2U);
  EXPECT_LT((scene.patches[0].normal - Vec3(0, -1, 0)).norm(), 1e-15);
  EXPECT_EQ(scene.Bounds().first, Vec3(0, 0, 0));
  EXPECT_EQ(scene.Bounds().second, Vec3(1, 5, 1));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].name, "a");
  EXPECT_EQ(scene.objects[1].name, "a_2");
  const Material& material = scene.MaterialOf(0);
  EXPECT_TRUE((material.reflectance == Rgb(0.5, 0.25, 0.125)).all());
  EXPECT_TRUE((material.emittance == Rgb(12, 6, 3)).all());
}

// A mirrored instance has its front on the mirrored side.
TEST_F(AssimpReaderTest, MirroredInstancesKeepTheirFronts) {
  const char* const nodes =
      R"([{"name":"a","mesh":0},{"name":"b","mesh":0,"scale":[-1,1,1],"translation":[0,0,-5]}])";
  const Scene scene = ReadNamedScene(Write("a.gltf", TriangleGltf(nodes, kBrown)), {});
  ASSERT_EQ(scene.patches.size(), 2U);
  EXPECT_LT((scene.patches[1].normal - scene.patches[0].normal).norm(), 1e-15);
}

// What a user says of unit and axis goes before what the file says: 250 mm are the number nearest to 0.25.
TEST_F(AssimpReaderTest, UnitsAndAxesAreTakenFromTheFileOrAsGiven) {
  std::string dae = BytesOf(ForeignPath("room.dae"));
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(dae.find(from), dae.npos);
    dae.replace(dae.find(from), from.size(), to);
  };
  replace("meter=\"1\"", "meter=\"0.0254\"");
  replace("Y_UP", "Z_UP");
  const std::string path = Write("inches.dae", dae);
  const Vec3 inches = ReadNamedScene(path, {}).Bounds().second;
  EXPECT_LT((inches - 0.0254 * Vec3(4, 3, 2.5)).norm(), 1e-7);
  const Vec3 given = ReadNamedScene(path, InFrame("mm", UpAxis::kY)).Bounds().second;
  EXPECT_LT((given - 0.001 * Vec3(4, 0, 3)).norm(), 1e-9);
  // Assimp's FBX files say that they are in centimetres and y is up.
  const auto [low, high] = ReadNamedScene(ForeignPath("room.fbx"), {}).Bounds();
  EXPECT_LT((low - 0.01 * Vec3(0, -2.5, 0)).norm(), 1e-8);
  EXPECT_LT((high - 0.01 * Vec3(4, 0, 3)).norm(), 1e-8);
}

// The same for OBJ files, whose numbers stay exact, and for the cameras of built-in scenes.
TEST_F(AssimpReaderTest, ObjFilesHaveUnitsAndAxes) {
  const std::string path = Write("a.obj", "v 0 0 0\nv 2800 0 0\nv 2800 700 0\nv 0 700 0\nf 1 2 3 4\n");
  const Scene flat = ReadNamedScene(path, InFrame("mm", UpAxis::kZ));
  EXPECT_EQ(flat.Bounds().second, Vec3(2.8, 0.7, 0));
  EXPECT_EQ(flat.patches[0].normal, Vec3::UnitZ());
  const Scene upright = ReadNamedScene(path, InFrame("mm", UpAxis::kY));
  EXPECT_EQ(upright.Bounds().second, Vec3(2.8, 0, 0.7));
  EXPECT_EQ(upright.patches[0].normal, Vec3(0, -1, 0));
  EXPECT_EQ(ReadNamedScene(path, InFrame("mm", UpAxis::kX)).patches[0].normal, Vec3(0, -1, 0));
  const Scene cornell = ReadNamedScene("cornell", {}),
              small = ReadNamedScene("cornell", InFrame("cm", UpAxis::kY));
  const Vec3 eye = cornell.cameras[0].eye;
  EXPECT_LT((small.cameras[0].eye - 0.01 * Vec3(eye.x(), -eye.z(), eye.y())).norm(), 1e-15);
  EXPECT_NEAR(small.Diagonal(), 0.01 * cornell.Diagonal(), 1e-12);
}

// Lights without an area, and geometry in an unknown encoding, would give a wrong picture: refused by name.
TEST_F(AssimpReaderTest, WhatWouldChangeTheLightIsRefused) {
  const std::string lights = R"(,"extensionsUsed":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":
{"lights":[{"name":"Lamp","type":"point"}]}})";
  const std::string nodes =
      R"([{"name":"a","mesh":0},{"name":"bulb","extensions":{"KHR_lights_punctual":{"light":0}}}])";
  EXPECT_THAT(ErrorOf(Write("l.gltf", TriangleGltf(nodes, kBrown, lights))),
              HasSubstr("1 light without an area: 'bulb'; "));
  const std::string packed = R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
  EXPECT_THAT(ErrorOf(Write("p.gltf", TriangleGltf(kTwoNodes, kBrown, packed))),
              HasSubstr("'KHR_draco_mesh_compression'"));
  const std::string white = R"([{"name":"snow","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]}}])";
  const std::string path = Write("w.gltf", TriangleGltf(kTwoNodes, white));
  EXPECT_THAT(ErrorOf(path), HasSubstr("'snow'"));
  SceneOptions clamp;
  clamp.max_reflectance = 0.9;
  EXPECT_EQ(ReadNamedScene(path, clamp).MaterialOf(0).reflectance[1], 0.9);
}

// Content goes before the name. What cannot be read is told in one line.
TEST_F(AssimpReaderTest, FilesAreWhatTheyContain) {
  const std::string glb = BytesOf(ForeignPath("room.glb"));
  for (const char* name : {"room", "room.obj", "room.stl"})
    EXPECT_EQ(ReadNamedScene(Write(name, glb), AsWritten()).objects.size(), 6U) << name;
  EXPECT_THAT(ErrorOf(Write("text.dae", "no XML")), HasSubstr("it cannot be read as COLLADA: "));
  EXPECT_THAT(ErrorOf(Write("picture.glb", "\x89PNG\r\n")), HasSubstr("this is a PNG image"));
  EXPECT_THAT(ErrorOf(Write("old.blend", "BLENDER-v279")),
              HasSubstr("this is a Blender file; give a scene file (.obj, "));
}

// Truncated and changed files are read or refused, and never end the program.
TEST_F(AssimpReaderTest, DamagedFilesAreReadOrRefused) {
  Random random(20);
  const auto below = [&](std::size_t n) { return random.Index(static_cast<std::uint32_t>(n)); };
  for (const char* name :
       {"room.glb", "room.gltf", "room.dae", "room.fbx", "room.3ds", "room.x3d", "room.stl", "room.ply"}) {
    const std::string whole = BytesOf(ForeignPath(name));
    int refused = 0;
    for (int run = 0; run < 25; ++run) {
      std::string bytes = whole.substr(0, run % 2 == 0 ? below(whole.size()) : whole.size());
      for (int change = 0; change < run % 7 && !bytes.empty(); ++change)
        bytes[below(bytes.size())] = static_cast<char>(random.Index(256));
      const std::string path = Write(std::string("damaged") + name, bytes);
      try {
        ReadNamedScene(path, {});
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr(": error: "));
        ++refused;
      }
    }
    EXPECT_GT(refused, 0) << name;
  }
}

}  // namespace
}  // namespace penumbra
