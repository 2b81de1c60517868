// `export` and `diff` from outside. What other programs make of the files is asked in tests/foreign.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "display/exr_image.h"
#include "solver/geometry/vec.h"
#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

// A scene written as OBJ is the same scene: probes give the same bytes. pbrt and MGF need no solve either.
TEST(Export, ScenesComeBack) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.3,-0.9,0,0,0,1\n0.1,-0.5,0.2,0.3,0.2,1\n");
  ASSERT_EQ(sandbox.Run({"export", "floating-cube", "-o", "a.obj"}).status, 0);
  const std::vector<std::string> rest = {"--points", "points.csv", "--error", "0.3"};
  std::vector<std::string> from_file = {"probe", "a.obj"}, built_in = {"probe", "floating-cube"};
  from_file.insert(from_file.end(), rest.begin(), rest.end());
  built_in.insert(built_in.end(), rest.begin(), rest.end());
  const Outcome outcome = sandbox.Run(from_file);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, sandbox.Run(built_in).out);
  ASSERT_EQ(sandbox.Run({"export", "cornell", "-o", "a.pbrt", "--camera", "blocks"}).status, 0);
  EXPECT_THAT(ReadBytes(sandbox.Path("a.pbrt")), HasSubstr("\"float fov\" 50\n"));
  ASSERT_EQ(sandbox.Run({"export", "cornell", "-o", "a.mgf"}).status, 0);
  EXPECT_THAT(sandbox.Files(), ElementsAre("a.mgf", "a.mtl", "a.obj", "a.pbrt", "points.csv"));
}

// Meshes have the same bytes for every number of threads, and of a scene without faces there is a file as
// well.
TEST(Export, MeshesAreTheSameForAnyThreads) {
  const Sandbox sandbox;
  sandbox.Write("empty.obj", "# nothing\n");
  for (const char* format : {".vtu", ".ply", ".glb", ".html"}) {
    const std::string one = std::string("one") + format, two = std::string("two") + format;
    ASSERT_EQ(sandbox.Run({"export", "furnace", "--error", "0.5", "-o", one, "--threads", "1"}).status, 0);
    ASSERT_EQ(sandbox.Run({"export", "furnace", "--error", "0.5", "-o", two, "--threads", "2"}).status, 0);
    EXPECT_EQ(ReadBytes(sandbox.Path(one)), ReadBytes(sandbox.Path(two)));
    EXPECT_EQ(sandbox.Run({"export", "empty.obj", "-o", one}).status, 0);
  }
}

// In a furnace, irradiance is the same everywhere, and so is every pixel of its map that lies on a chart.
TEST(Export, MapsHoldIrradiance) {
  const Sandbox sandbox;
  const std::vector<std::string> solved = {"solve", "furnace", "--error", "0.1", "-o", "a.h5"};
  ASSERT_EQ(sandbox.Run(solved).status, 0);
  for (const char* file : {"a.exr", "a.png", "a.glb"})
    ASSERT_EQ(sandbox.Run({"export", "a.h5", "-o", file, "--atlas", "128"}).status, 0);
  const RgbImage map = ReadExr(sandbox.Path("a.exr"));
  ASSERT_EQ(map.width, 128);
  sandbox.Write("points.csv", "x,y,z,nx,ny,nz\n0.5,0.5,0,0,0,1\n");
  const std::string row = Lines(sandbox.Run({"probe", "a.h5", "--points", "points.csv"}).out).at(1);
  const double want = std::stod(Fields(row).at(10));
  int lit = 0;
  for (const float value : map.channel[0])
    if (value > 0) {
      ++lit;
      EXPECT_NEAR(static_cast<double>(value), want, 0.01 * want);
    }
  EXPECT_GT(lit, 128 * 128 / 4);
  EXPECT_EQ(ReadBytes(sandbox.Path("a.png")).substr(1, 3), "PNG");
  const std::string glb = ReadBytes(sandbox.Path("a.glb"));
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const json gltf = json::parse(glb.substr(20, length));
  EXPECT_EQ(gltf["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"], 1);
  EXPECT_EQ(gltf["nodes"][0]["rotation"].size(), 4U);
  EXPECT_EQ(gltf["scenes"][0]["nodes"], json::array({0}));
}

// The numbers of this type, so many in a row.
template <class Scalar>
std::vector<double> Numbers(const std::string& bytes, std::size_t at, std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    Scalar value;
    std::memcpy(&value, bytes.data() + at + i * sizeof(Scalar), sizeof(Scalar));
    numbers.push_back(static_cast<double>(value));
  }
  return numbers;
}

// What base64 stands for.
std::string Decoded(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t word = 0;
  int bits = 0;
  for (const char digit : text) {
    if (digit == '=') break;
    word = word << 6 | static_cast<std::uint32_t>(kDigits.find(digit));
    bits += 6;
    if (bits >= 8) bytes.push_back(static_cast<char>(word >> (bits -= 8) & 255));
  }
  return bytes;
}

// In every format a room lies where it is, to the last digit, however far from the origin: map coordinates
// have more digits than floats. The corners of the room are among the vertices, and nothing lies outside.
TEST(Export, MapCoordinatesKeepTheirDigits) {
  const Sandbox sandbox;
  sandbox.Write("utm.mtl", "newmtl warm\nKd 0.5 0.5 0.5\nKe 1 1 1\n");
  sandbox.Write("utm.obj",
                "mtllib utm.mtl\nusemtl warm\nv 512345.125 5403210.5 118\nv 512345.375 5403210.5 118\n"
                "v 512345.375 5403210.75 118\nv 512345.125 5403210.75 118\nf 1 2 3 4\n");
  const Vec3 low(512345.125, 5403210.5, 118), high(512345.375, 5403210.75, 118);
  const auto expect_box = [&](const std::vector<double>& numbers, std::size_t stride, const Vec3& at) {
    Vec3 least = Vec3::Constant(INFINITY), most = -least;
    for (std::size_t i = 0; i + 2 < numbers.size(); i += stride) {
      const Vec3 v = at + Vec3(numbers[i], numbers[i + 1], numbers[i + 2]);
      least = least.cwiseMin(v);
      most = most.cwiseMax(v);
    }
    EXPECT_EQ(least, low);
    EXPECT_EQ(most, high);
  };
  for (const char* file : {"a.ply", "a.vtu", "a.glb"})
    ASSERT_EQ(sandbox.Run({"export", "utm.obj", "--error", "0.5", "-o", file}).status, 0);

  const std::string ply = ReadBytes(sandbox.Path("a.ply"));
  EXPECT_THAT(ply, HasSubstr("property double x\nproperty double y\nproperty double z\n"));
  const std::size_t begin = ply.find("end_header\n") + 11;
  const auto count = static_cast<std::size_t>(std::stoul(ply.substr(ply.find("element vertex ") + 15)));
  constexpr std::size_t kVertex = 3 * 8 + 3 + 6 * 4;
  std::vector<double> corners;
  for (std::size_t i = 0; i < count; ++i)
    for (const double x : Numbers<double>(ply, begin + i * kVertex, 3)) corners.push_back(x);
  expect_box(corners, 3, Vec3::Zero());

  const std::string vtu = ReadBytes(sandbox.Path("a.vtu"));
  const std::string name =
      "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"binary\">";
  const std::size_t from = vtu.find(name) + name.size();
  const std::string points = Decoded(std::string_view(vtu).substr(from, vtu.find('<', from) - from));
  expect_box(Numbers<double>(points, 8, (points.size() - 8) / 8), 3, Vec3::Zero());

  const std::string glb = ReadBytes(sandbox.Path("a.glb"));
  std::uint32_t length = 0;
  std::memcpy(&length, glb.data() + 12, 4);
  const json gltf = json::parse(glb.substr(20, length));
  const json& at = gltf["nodes"][0]["translation"];  // y up
  const std::size_t vertices = gltf["accessors"][0]["count"];
  expect_box(Numbers<float>(glb, 20 + length + 8, 3 * vertices), 3,
             Vec3(at[0].get<double>(), -at[2].get<double>(), at[1].get<double>()));
}

// Maps by the scene's own texture coordinates: two squares that face each other lie side by side, and a
// solution file keeps the coordinates.
TEST(Export, MapsByTheSceneOwnTextureCoordinates) {
  const Sandbox sandbox;
  sandbox.Write("a.obj",
                "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
                "vt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nvt 1 0\nvt 1 1\n"
                "usemtl lamp\nf 1/1 2/2 3/3 4/4\nusemtl grey\nf 5/2 8/5 7/6 6/3\n");
  sandbox.Write("a.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 1 1\nnewmtl grey\nKd 0.5 0.5 0.5\n");
  ASSERT_EQ(sandbox.Run({"solve", "a.obj", "--error", "0.1", "-o", "a.h5"}).status, 0);
  std::vector<std::string> arguments = {"export", "a.h5", "-o", "a.h5.exr", "--atlas", "64", "--uv", "scene"};
  const Outcome of_solution = sandbox.Run(arguments);
  ASSERT_EQ(of_solution.status, 0) << of_solution.err;
  arguments[1] = "a.obj";
  arguments[3] = "a.obj.exr";
  arguments.insert(arguments.end(), {"--error", "0.1"});
  const Outcome of_scene = sandbox.Run(arguments);
  ASSERT_EQ(of_scene.status, 0) << of_scene.err;
  EXPECT_EQ(ReadBytes(sandbox.Path("a.obj.exr")), ReadBytes(sandbox.Path("a.h5.exr")));
  const RgbImage map = ReadExr(sandbox.Path("a.obj.exr"));
  // The lamp receives a twelfth or so of what it sends; the grey square is lit most in the middle.
  EXPECT_GT(map.At(48, 32).x, map.At(33, 1).x);
  EXPECT_GT(map.At(33, 1).x, map.At(16, 32).x);
  ASSERT_EQ(sandbox.Run({"export", "a.h5", "-o", "a.glb", "--atlas", "64", "--uv", "scene"}).status, 0);
}

// What cannot be written is bad usage, and nothing is written.
TEST(Export, RefusesOtherEndings) {
  const Sandbox sandbox;
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.stl"}).status, 2);
  EXPECT_EQ(sandbox.Run({"export", "furnace"}).status, 2);
  EXPECT_THAT(sandbox.Run({"export", "furnace", "-o", "a.exr"}).err, HasSubstr("--atlas"));
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.exr"}).status, 2);
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.vtu", "--atlas", "64"}).status, 2);
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.exr", "--atlas", "64", "--exposure", "1"}).status, 2);
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.ply", "--uv", "scene"}).status, 2);
  EXPECT_THAT(sandbox.Run({"export", "furnace", "-o", "a.exr", "--atlas", "64", "--uv", "scene"}).err,
              HasSubstr("no texture coordinates"));
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "a.ply", "--eye", "1,1,1"}).status, 2);
  EXPECT_EQ(sandbox.Run({"export", "furnace", "-o", "nowhere/a.ply"}).status, 1);
  EXPECT_EQ(sandbox.Run({"diff", "a.exr"}).status, 2);
  EXPECT_THAT(sandbox.Files(), ElementsAre());
}

// A picture is no different from itself; one of twice the values is off by 1 in every channel; sizes have to
// agree.
TEST(Diff, TellsHowFarPicturesAre) {
  const Sandbox sandbox;
  RgbImage a(20, 10);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 20; ++x)
      a.Set(x, y, {1, 0.5F + 0.01F * static_cast<float>(x), 0.25F + 0.01F * static_cast<float>(y)});
  RgbImage b = a;
  for (auto& plane : b.channel)
    for (float& value : plane) value *= 2;
  WriteExr(sandbox.Path("a.exr"), a);
  WriteExr(sandbox.Path("b.exr"), b);
  WriteExr(sandbox.Path("c.exr"), RgbImage(20, 11));
  const json same = json::parse(sandbox.Run({"diff", "a.exr", "a.exr", "--json"}).out);
  EXPECT_EQ(same["flip"]["max"], 0);
  EXPECT_EQ(same["relative"]["red"]["max"], 0);
  EXPECT_EQ(same["relative"]["blue"]["mean_ratio"], 1);
  const Outcome twice = sandbox.Run({"diff", "a.exr", "b.exr", "--json", "-o", "map.png"});
  ASSERT_EQ(twice.status, 0) << twice.err;
  const json other = json::parse(twice.out);
  for (const char* channel : {"red", "green", "blue"}) {
    for (const char* measure : {"max", "p99", "p95", "rms"})
      EXPECT_NEAR(other["relative"][channel][measure].get<double>(), 1, 1e-12);
    EXPECT_NEAR(other["relative"][channel]["mean_ratio"].get<double>(), 2, 1e-12);
  }
  EXPECT_GT(other["flip"]["mean"], 0.05);
  EXPECT_LE(other["flip"]["max"], 1);
  EXPECT_EQ(ReadBytes(sandbox.Path("map.png")).substr(1, 3), "PNG");
  const Outcome text = sandbox.Run({"diff", "a.exr", "b.exr", "--seed", "7", "--threads", "1", "-v"});
  EXPECT_THAT(text.out, HasSubstr("visible difference"));
  EXPECT_EQ(text.err, "Options used:\n   --threads 1\n   --seed 7\n   --pixels-per-degree 67.0206\n");

  const Outcome sizes = sandbox.Run({"diff", "a.exr", "c.exr"});
  EXPECT_EQ(sizes.status, 1);
  EXPECT_THAT(sizes.err, HasSubstr("c.exr: error: it has 20x11 pixels, but a.exr has 20x10"));
  b.Set(3, 4, {NAN, 0, 0});
  WriteExr(sandbox.Path("b.exr"), b);
  EXPECT_EQ(sandbox.Run({"diff", "a.exr", "b.exr"}).status, 1);
}

}  // namespace
}  // namespace penumbra
