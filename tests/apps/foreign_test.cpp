// A room has the same light whichever program wrote its file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "test_paths.h"
#include "tests/apps/run_program.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

std::string Foreign(const std::string& name) {
  return (std::filesystem::path(PENUMBRA_SOURCE_DIR) / "tests/foreign" / name).string();
}

constexpr const char* kPlaces =
    "x,y,z,nx,ny,nz\n2,1.5,0,0,0,1\n0.2,0.3,0,0,0,1\n4,2,1.25,-1,0,0\n2,1.4,2.5,0,0,-1\n"
    "1,1,0.8,0,0,1\n3.25,0.25,1,0,0,1\n2,1.5,1,1,2,3\n";

// The columns of exact irradiance of all points.
std::vector<double> IrradianceOf(const Outcome& probed) {
  std::vector<double> values;
  const std::vector<std::string> lines = Lines(probed.out);
  for (std::size_t i = 1; i < lines.size(); ++i)
    for (std::size_t column = 7; column < 10; ++column)
      values.push_back(std::stod(Fields(lines[i]).at(column)));
  return values;
}

void ExpectSameLight(const std::vector<double>& got, const std::vector<double>& want, double share,
                     const std::string& what) {
  ASSERT_EQ(got.size(), want.size()) << what;
  ASSERT_EQ(want.size(), 21U) << what;
  for (std::size_t i = 0; i < want.size(); ++i) {
    EXPECT_GT(want[i], 1e-3) << what;
    EXPECT_NEAR(got[i], want[i], share * want[i]) << what << ", value " << i;
  }
}

// The error asked for bounds the difference of solutions; single precision moves the corners by 1e-7 only.
TEST(Foreign, RoomsOfAssimpHaveTheLightOfTheObj) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kPlaces);
  const auto probe = [&](const std::string& scene) {
    return sandbox.Run(
        {"probe", scene, "--points", "points.csv", "--error", "0.2", "--unit", "m", "--up", "z"});
  };
  const std::vector<double> want = IrradianceOf(probe(Foreign("room.obj")));
  for (const char* name : {"room.glb", "room.gltf", "room.dae", "room.fbx", "room.3ds", "room.x3d"}) {
    const Outcome outcome = probe(Foreign(name));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    ExpectSameLight(IrradianceOf(outcome), want, 1e-3, name);
    EXPECT_THAT(outcome.err, HasSubstr("note: read as "));
  }
}

// What is exported as MGF, or as GLB with y up, has the light of its scene when it is read again.
TEST(Foreign, ExportsHaveTheLightOfTheirScene) {
  const Sandbox sandbox;
  sandbox.Write("points.csv", kPlaces);
  ASSERT_EQ(sandbox.Run({"export", Foreign("room.obj"), "-o", "room.mgf"}).status, 0);
  const auto probe = [&](const std::string& scene) {
    return IrradianceOf(sandbox.Run({"probe", scene, "--points", "points.csv", "--error", "0.2"}));
  };
  ExpectSameLight(probe("room.mgf"), probe(Foreign("room.obj")), 1e-3, "MGF");
}

// One option says two things: the axis of the file and the direction that is up in the picture.
TEST(Foreign, UpIsAnAxisOrADirection) {
  const Sandbox sandbox;
  const std::vector<std::string> render = {"render", "furnace", "-o",      "a.png",
                                           "--size", "16x16",   "--error", "0.5"};
  const auto with = [&](std::vector<std::string> more) {
    std::vector<std::string> words = render;
    words.insert(words.end(), more.begin(), more.end());
    return sandbox.Run(words);
  };
  EXPECT_EQ(with({"--up", "y", "--up", "0,1,0"}).status, 0);
  EXPECT_EQ(with({"--up", "w"}).status, 2);
  EXPECT_EQ(with({"--up", "0,0,0"}).status, 2);
  EXPECT_EQ(sandbox.Run({"info", "furnace", "--unit", "mm", "--up", "y"}).status, 0);
  EXPECT_EQ(sandbox.Run({"info", "furnace", "--unit", "furlong"}).status, 2);
  EXPECT_EQ(sandbox.Run({"info", "furnace", "--up", "0,0,1"}).status, 2);
  ASSERT_EQ(sandbox.Run({"solve", "furnace", "-o", "a.h5", "--error", "0.5"}).status, 0);
  EXPECT_EQ(sandbox.Run({"render", "a.h5", "-o", "b.png", "--size", "16x16", "--up", "0,1,0"}).status, 0);
  EXPECT_EQ(sandbox.Run({"render", "a.h5", "-o", "b.png", "--size", "16x16", "--up", "y"}).status, 2);
  EXPECT_EQ(sandbox.Run({"info", "a.h5", "--unit", "mm"}).status, 2);
}

}  // namespace
}  // namespace penumbra
