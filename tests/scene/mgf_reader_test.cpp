// The Materials and Geometry Format: what `export` writes is the scene again; transformations, colours and
// curved surfaces by closed forms.

#include "solver/scene/mgf_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/base/check.h"
#include "solver/scene/curved_surfaces.h"
#include "solver/scene/mgf_colour.h"
#include "solver/scene/mgf_writer.h"
#include "solver/scene/named_scene.h"
#include "tests/scene/temporary_folder.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

class MgfReaderTest : public scene_test::TestWithFolder {
 protected:
  Scene Read(std::string_view text, const SceneOptions& options = {}) const {
    return ReadNamedScene(Write("a.mgf", text), options);
  }
  // The message without the path.
  std::string ErrorOf(std::string_view text) const {
    const std::string path = Write("a.mgf", text);
    try {
      ReadMgf(path, {});
    } catch (const InputError& error) {
      const std::string message = error.what();
      return message.starts_with(path) ? message.substr(path.size()) : message;
    }
    return "";
  }
};

double AreaOf(const Scene& scene) {
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  return area;
}

// Six times the volume that fronts enclose: the sum of v0 . (v1 x v2) over a fan of triangles.
double VolumeInside(const Scene& scene) {
  double six = 0;
  for (const Patch& patch : scene.patches)
    for (int i = 1; i + 1 < patch.size; ++i)
      six += patch.vertex[0].dot(
          patch.vertex[static_cast<std::size_t>(i)].cross(patch.vertex[static_cast<std::size_t>(i) + 1]));
  return six / 6;
}

// Areas times the materials' colours, over all patches.
std::pair<Rgb, Rgb> PowerAndReflectance(const Scene& scene) {
  Rgb power = Rgb::Zero(), reflecting = Rgb::Zero();
  for (const Patch& patch : scene.patches) {
    const Material& material = scene.materials[static_cast<std::size_t>(patch.material)];
    power += material.emittance * patch.area;
    reflecting += material.reflectance * patch.area;
  }
  return {power, reflecting};
}

// Scene to MGF to scene: the same fronts, reflectances and emittances to rounding. (Patches are written, and
// may be cut in another way when they are read as faces.)
TEST_F(MgfReaderTest, ReadsWhatIsExported) {
  constexpr double kRounding = 1e-10;  // of the crossings where faces were cut, written and cut again
  for (const char* name : {"office", "cornell", "floating-cube"}) {
    const Scene scene = ReadNamedScene(name, {}), again = Read(MgfText(scene));
    EXPECT_NEAR(AreaOf(again), AreaOf(scene), kRounding * AreaOf(scene)) << name;
    EXPECT_NEAR(VolumeInside(again), VolumeInside(scene), kRounding * AreaOf(scene)) << name;
    EXPECT_EQ(again.Bounds(), scene.Bounds()) << name;
    const auto [power, reflecting] = PowerAndReflectance(again);
    const auto [want_power, want_reflecting] = PowerAndReflectance(scene);
    EXPECT_LT((power - want_power).abs().maxCoeff(), kRounding * want_power.maxCoeff()) << name;
    EXPECT_LT((reflecting - want_reflecting).abs().maxCoeff(), kRounding * want_reflecting.maxCoeff())
        << name;
  }
}

constexpr const char* kPoints =
    "m grey =\n sides 1\n c\n rd 0.5\nv a =\n p 0 0 0\n n 0 0 1\nv b =\n p 1 0 0\nv c =\n p 1 1 0\nv d =\n p "
    "0 1 0\n"
    "v top =\n p 0 0 2\n";

// An array of squares, moved, turned, scaled and mirrored: areas by the square of the scale, fronts as
// turned.
TEST_F(MgfReaderTest, TransformationsMoveTurnAndRepeat) {
  const Scene scene = Read(std::string(kPoints) +
                           "o tiles\nxf -rx 90 -s 2 -t 0 0 5 -a 3 -t 10 0 0\nf a b c d\nxf\no\nf a b c d\n");
  ASSERT_EQ(scene.patches.size(), 4U);
  for (int i = 0; i < 3; ++i) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(i)];
    EXPECT_EQ(patch.area, 4);
    EXPECT_EQ(patch.normal, Vec3(0, -1, 0));
    EXPECT_EQ(patch.vertex[0], Vec3(10 * i, 0, 5));
  }
  EXPECT_EQ(scene.patches[3].normal, Vec3::UnitZ());
  EXPECT_EQ(scene.objects[0].name, "tiles");
  EXPECT_EQ(scene.objects[0].faces.size(), 3U);
  // A mirror keeps the front of a face in front of the mirrored body.
  const Scene mirrored = Read(std::string(kPoints) + "xf -mx\nf a b c d\nxf\n");
  EXPECT_EQ(mirrored.patches[0].normal, Vec3::UnitZ());
  EXPECT_EQ(mirrored.Bounds().first, Vec3(-1, 0, 0));
}

// `sides 2`, the default, makes a second face, which emits and reflects, too.
TEST_F(MgfReaderTest, SurfacesHaveTwoSidesUnlessTheySayOne) {
  const std::string text = "m\nc\ned 3\nv a =\np 0 0 0\nv b =\np 1 0 0\nv c =\np 0 1 0\nf a b c\n";
  const Scene two = Read(text);
  ASSERT_EQ(two.patches.size(), 2U);
  EXPECT_EQ(two.patches[0].normal, -two.patches[1].normal);
  EXPECT_LT((two.MaterialOf(1).emittance - Rgb::Constant(3)).abs().maxCoeff(), 1e-14);
  SceneOptions options;
  options.two_sided = true;
  EXPECT_EQ(Read(text, options).patches.size(), 2U);
}

// Areas and volumes of curved surfaces: inscribed, within twice the tolerance of the closed form, and closed.
TEST_F(MgfReaderTest, CurvedSurfacesAreCutWithinTheTolerance) {
  constexpr double kPi = std::numbers::pi;
  struct Solid {
    const char* text;
    double area, volume;
  };
  const Solid solids[] = {
      {"sph a 2\n", 16 * kPi, 32 * kPi / 3},
      {"cyl a 1 top\nring a2 0 1\nring top2 0 1\n", 6 * kPi, 2 * kPi},
      {"cone a 1 top 0\nring a2 0 1\n", kPi * std::sqrt(5.0) + kPi, 2 * kPi / 3},
      {"torus a 2 4\n", 4 * kPi * kPi * 3, 2 * kPi * kPi * 3},
      {"prism a b c d 3\n", 14, 3},
  };
  for (const Solid& solid : solids) {
    const Scene scene =
        Read(std::string(kPoints) + "v a2 =\np 0 0 0\nn 0 0 -1\nv top2 =\np 0 0 2\nn 0 0 1\n" + solid.text);
    const double area = AreaOf(scene), volume = VolumeInside(scene);
    EXPECT_LE(area, solid.area * (1 + 1e-12)) << solid.text;
    EXPECT_GE(area, solid.area * (1 - 2 * kCurveTolerance)) << solid.text;
    EXPECT_LE(volume, solid.volume * (1 + 1e-12)) << solid.text;
    EXPECT_GE(volume, solid.volume * (1 - 3 * kCurveTolerance)) << solid.text;
    Vec3 closed = Vec3::Zero();
    for (const Patch& patch : scene.patches) closed += patch.area * patch.normal;
    EXPECT_LT(closed.norm(), 1e-13 * area) << solid.text;
  }
  // A negative radius turns the inside out.
  EXPECT_LT(VolumeInside(Read(std::string(kPoints) + "sph a -2\n")), -30);
}

// White is white; a mixture of equal luminances of two colours has the luminance of both; 6504 K is near the
// white point D65 (which is not a black body: 0.3135, 0.3237 is), equal energy is white.
TEST_F(MgfReaderTest, ColoursFollowCie) {
  const Vec3 hot = BlackBodyXyz(6504);
  EXPECT_NEAR(hot.x() / hot.sum(), 0.3135, 0.004);
  EXPECT_NEAR(hot.y() / hot.sum(), 0.3237, 0.004);
  const double flat[] = {1, 1};
  const Vec3 equal = SpectrumXyz(380, 780, flat);
  EXPECT_NEAR(equal.x(), 1, 0.01);
  EXPECT_NEAR(equal.z(), 1, 0.01);
  const std::string mix =
      "c red =\ncxy 0.64 0.33\nc green =\ncxy 0.29 0.6\nc both =\ncmix 1 red 1 green\nm =\nsides 1\nc "
      "both\nrd 0.4\n"
      "v a =\np 0 0 0\nv b =\np 1 0 0\nv c =\np 0 1 0\nf a b c\n";
  const Rgb rgb = Read("m\n" + mix.substr(0, mix.find("m =")) + "m\n" + mix.substr(mix.find("sides")))
                      .MaterialOf(0)
                      .reflectance;
  EXPECT_NEAR(MgfXyz(rgb).y(), 0.4, 1e-12);
  EXPECT_NEAR(MgfXyz(Rgb(rgb[0], 0, 0)).y(), 0.2, 1e-12);
  EXPECT_NEAR(MgfXyz(Rgb(0, rgb[1], 0)).y(), 0.2, 1e-12);
}

// Faces with holes, files in files, and what is left out.
TEST_F(MgfReaderTest, HolesIncludesAndWarnings) {
  Write("part.mgf", "f a b c d\n");
  const Scene scene =
      Read(std::string(kPoints) +
           "m gloss = grey\n rs 0.2 0.1\ni part.mgf -t 0 0 3\n"
           "v h1 =\np 0.25 0.25 0\nv h2 =\np 0.75 0.25 0\nv h3 =\np 0.75 0.75 0\nv h4 =\np 0.25 0.75 0\n"
           "fh a b c d - h1 h2 h3 h4\n");
  EXPECT_NEAR(AreaOf(scene), 1.75, 1e-12);
  ASSERT_EQ(scene.warnings.size(), 2U);
  EXPECT_THAT(scene.warnings[0], HasSubstr(": note: read as MGF, "));
  EXPECT_THAT(scene.warnings[1], HasSubstr("left out: the specular parts of 1 material: 'gloss'"));
}

TEST_F(MgfReaderTest, ErrorsNameTheLine) {
  EXPECT_THAT(ErrorOf("v a\n"), HasSubstr(":1: error: 'v': 'a' is not defined"));
  EXPECT_THAT(ErrorOf("f x y z\n"), HasSubstr(":1: error: 'f': 'x' is not defined"));
  EXPECT_THAT(ErrorOf("v a =\np 1 2\n"), HasSubstr(":2: error: 'p': it has 2 values"));
  EXPECT_THAT(ErrorOf("v a =\np 1 2 nan\n"), HasSubstr(":2: error: 'p': 'nan' is no finite number"));
  EXPECT_THAT(ErrorOf("xf -t 1\nxf\n"), HasSubstr(":1: error: 'xf': -t takes 3 numbers"));
  EXPECT_THAT(ErrorOf("xf -a 1e9\nxf\n"), HasSubstr(":1: error: 'xf': the number of copies"));
  EXPECT_THAT(ErrorOf("xf\n"), HasSubstr(":1: error: 'xf': "));
  EXPECT_THAT(ErrorOf("i a.mgf\n"), HasSubstr("more than 16 deep"));
  EXPECT_THAT(ErrorOf("i none.mgf\n"), HasSubstr("none.mgf: error: there is no such file"));
  EXPECT_THAT(ErrorOf("nonsense 1 2 3\n"), HasSubstr(":1: error: 'nonsense': this is no keyword"));
  EXPECT_THAT(ErrorOf("m a =\nc\nrd 1.5\nv a =\np 0 0 0\nv b =\np 1 0 0\nv c =\np 0 1 0\nf a b c\n"),
              HasSubstr(": error: the reflectance of the material 'a'"));
}

}  // namespace
}  // namespace penumbra
