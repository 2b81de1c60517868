// Scene descriptions of Radiance: materials, sides, transformations by commands, curved surfaces, errors.

#include "solver/scene/rad_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "solver/base/check.h"
#include "solver/scene/curved_surfaces.h"
#include "solver/scene/named_scene.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

constexpr double kPi = std::numbers::pi;

class RadReaderTest : public scene_test::TestWithFolder {
 protected:
  Scene Read(std::string_view text, const SceneOptions& options = {}) const {
    return ReadNamedScene(Write("a.rad", text), options);
  }
  std::string ErrorOf(std::string_view text) const {
    const std::string path = Write("a.rad", text);
    try {
      ReadRad(path, {});
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path)) << message;
      return message.substr(path.size());
    }
    return "";
  }
};

constexpr const char* kMaterials =
    "# a comment\nvoid plastic white\n0\n0\n5 .8 .4 .2 0.5 0\nvoid light bright 0 0 3\n\t2 1 # and another\n "
    " 0.5\n"
    "white alias snow white\nvoid glass pane 0 0 3 .9 .9 .9\n";

// Lights give radiance, which times pi is emittance, from the front; plastic reflects its diffuse part on
// both sides.
TEST_F(RadReaderTest, MaterialsGiveTheirDiffusePart) {
  const Scene scene = Read(std::string(kMaterials) +
                           "bright polygon lamp 0 0 9 0 0 2  0 1 2  1 0 2\n"
                           "snow polygon floor\n0\n0\n12\n0 0 0 2 0 0\n2 2 0 0 2 0\n");
  ASSERT_EQ(scene.patches.size(), 3U);
  EXPECT_LT((scene.MaterialOf(0).emittance - kPi * Rgb(2, 1, 0.5)).abs().maxCoeff(), 1e-14);
  EXPECT_EQ(scene.patches[0].normal, -Vec3::UnitZ());
  EXPECT_LT((scene.MaterialOf(1).reflectance - Rgb(0.4, 0.2, 0.1)).abs().maxCoeff(), 1e-15);
  EXPECT_EQ(scene.patches[1].normal, -scene.patches[2].normal);
  EXPECT_EQ(scene.objects[1].name, "floor");
  ASSERT_EQ(scene.warnings.size(), 2U);
  EXPECT_THAT(scene.warnings[1], HasSubstr("left out: the specular part of 1 material: 'snow'"));
}

// Commands are obeyed without a shell: boxes, files moved, turned and repeated, and pipes of both.
TEST_F(RadReaderTest, CommandsMoveAndRepeat) {
  Write("tile.rad", "bright polygon tile 0 0 12  0 0 0  1 0 0  1 1 0  0 1 0\n");
  const Scene scene = Read(std::string(kMaterials) +
                           "!xform -n row -s 2 -a 3 -t 5 0 0 tile.rad\n!xform -mz -t 0 0 1 \\\n tile.rad\n");
  ASSERT_EQ(scene.patches.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.patches[static_cast<std::size_t>(i)].area, 4);
    EXPECT_EQ(scene.patches[static_cast<std::size_t>(i)].vertex[0], Vec3(5 * i, 0, 0));
  }
  EXPECT_EQ(scene.objects[0].name, "row.tile");
  // A mirror turns what looked up downwards.
  EXPECT_EQ(scene.patches[3].normal, -Vec3::UnitZ());
  const Scene box = Read(std::string(kMaterials) + "!genbox bright box 1 2 3 | xform -t 10 0 0\n");
  EXPECT_EQ(box.Bounds().first, Vec3(10, 0, 0));
  EXPECT_EQ(box.Bounds().second, Vec3(11, 2, 3));
  double volume = 0;
  for (const Patch& patch : box.patches) volume += patch.normal.dot(patch.vertex[0]) * patch.area / 3;
  EXPECT_NEAR(volume, 6, 1e-12);
}

// Power of curved lamps: pi times radiance times area, within twice the tolerance.
TEST_F(RadReaderTest, CurvedLampsKeepTheirPower) {
  struct Lamp {
    const char* text;
    double area;
  };
  for (const Lamp& lamp :
       {Lamp{"bright sphere s 0 0 4 1 2 3 0.5", kPi}, Lamp{"bright ring r 0 0 8 0 0 2 0 0 -1 0 1", kPi},
        Lamp{"bright cylinder c 0 0 7 0 0 0 0 3 4 0.1", kPi},
        Lamp{"bright cone k 0 0 8 0 0 0 0 0 0.75 1 0", kPi * 1.25}}) {
    const Scene scene = Read(std::string(kMaterials) + lamp.text);
    double power = 0;
    for (std::size_t i = 0; i < scene.patches.size(); ++i)
      power += scene.MaterialOf(static_cast<PatchId>(i)).emittance[1] * scene.patches[i].area;
    EXPECT_LE(power, kPi * lamp.area * (1 + 1e-12)) << lamp.text;
    EXPECT_GE(power, kPi * lamp.area * (1 - 2 * kCurveTolerance)) << lamp.text;
  }
}

// Clear surfaces let light pass and are left out; so is what shines from beyond the scene.
TEST_F(RadReaderTest, WhatIsLeftOutIsNamed) {
  const Scene scene = Read(std::string(kMaterials) +
                           "pane polygon window 0 0 9 0 0 2  0 1 2  1 0 2\n"
                           "bright source sun 0 0 4 0 0 1 0.5\n");
  EXPECT_TRUE(scene.faces.empty());
  ASSERT_EQ(scene.warnings.size(), 3U);
  EXPECT_THAT(scene.warnings[1], HasSubstr("clear, of 1 material: 'pane'"));
  EXPECT_THAT(scene.warnings[2], HasSubstr("1 primitive of the type source"));
}

TEST_F(RadReaderTest, ErrorsNameTheLine) {
  EXPECT_THAT(ErrorOf("\nvoid plastic"), HasSubstr(":2: error: the text ends"));
  EXPECT_THAT(ErrorOf("void plastic a 0 0 x"), HasSubstr(":1: error: 'x' is no number of arguments"));
  EXPECT_THAT(ErrorOf("void plastic a 0 0 5 1 1 nan 0 0"), HasSubstr(":1: error: 'nan' is no finite number"));
  EXPECT_THAT(ErrorOf("void plastic a 0 0 999999999 1 1"), HasSubstr(":1: error: the text ends"));
  EXPECT_THAT(ErrorOf("void plastic a 0 0 1 1\n"), HasSubstr(":1: error: plastic 'a': it has 1 numbers"));
  EXPECT_THAT(ErrorOf("none polygon a 0 0 9 0 0 0 1 0 0 0 1 0"),
              HasSubstr(":1: error: polygon 'a': the modifier 'none'"));
  EXPECT_THAT(ErrorOf("!rm -rf x\n"), HasSubstr(":1: error: the command: 'rm' is not obeyed"));
  EXPECT_THAT(ErrorOf("\n!xform -t 1 2 a.rad\n"), HasSubstr(":2: error: the command: -t takes 3 numbers"));
  EXPECT_THAT(ErrorOf("!xform a.rad\n"), HasSubstr("more than 16 deep"));
  EXPECT_THAT(ErrorOf("void plastic a 0 0 5 1 1 1 0 0\na polygon p 0 0 9 0 0 0 1 0 0 0 1 0\n"),
              HasSubstr(": error: the reflectance of the material 'a'"));
}

}  // namespace
}  // namespace penumbra
