// Irradiance maps: each pixel holds the light of its own patch, at its own place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "display/atlas/atlas_files.h"
#include "display/atlas/light_atlas.h"
#include "solver/base/check.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

// Irradiance is a quadratic of the place, so that the map is known exactly: at the centre of each pixel whose
// place lies on the patch, it is the field there, to the precision of floats.
TEST(LightAtlas, HoldsTheFieldAtPixelCentres) {
  const SyntheticScene room = MakeRoom(2);
  const LightAtlas atlas = MakeLightAtlas(room.scene, room.mesh, 1024);
  const ChartLayout& layout = atlas.layout;
  ASSERT_EQ(layout.charts.size(), room.scene.patches.size());
  double worst = 0, area = 0;
  for (const Chart& chart : layout.charts) {
    const Patch& patch = room.scene.patches[static_cast<std::size_t>(chart.patch)];
    EXPECT_NEAR((chart.v.cross(chart.u) - patch.normal).norm(), 0, 1e-12);
    EXPECT_GE(chart.across, chart.along);
    int inside = 0;
    for (int y = chart.y; y < chart.y + chart.height; ++y)
      for (int x = chart.x; x < chart.x + chart.width; ++x) {
        const std::size_t i = atlas.irradiance.Index(x, y);
        ASSERT_EQ(atlas.patch[i], chart.patch);
        const Vec3 point = layout.PointAt(chart, x + 0.5, y + 0.5);
        EXPECT_NEAR((layout.PixelOf(chart, point) - Eigen::Vector2d(x + 0.5, y + 0.5)).norm(), 0, 1e-9);
        const Vec3 from = point - chart.corner;
        const double u = chart.u.dot(from), v = chart.v.dot(from);
        if (u < 0 || v < 0 || u > chart.across || v > chart.along) continue;  // patches are rectangles here
        ++inside;
        const Rgb field = QuadraticField(point, patch.normal);
        for (std::size_t c = 0; c < 3; ++c) {
          const double want = field[static_cast<Eigen::Index>(c)];
          worst = std::max(worst, std::abs(static_cast<double>(atlas.irradiance.channel[c][i]) / want - 1));
        }
      }
    EXPECT_GT(inside, 0);
    area += chart.across * chart.along;
  }
  std::cout << "largest relative error " << worst << ", " << layout.pixels_per_metre << " pixels a metre\n";
  EXPECT_LT(worst, 1e-6);
  // The charts fill a good part of the picture.
  EXPECT_GT(area * layout.pixels_per_metre * layout.pixels_per_metre, 0.35 * 1024 * 1024);
}

// The mean of blocks of 2 x 2 pixels, by channel.
RgbImage Halved(const RgbImage& image) { return Downsample(image, 2, 2); }

// Beside a bright patch a dark one stays dark, and the bright one bright: what a bilinear filter reads around
// any point of a patch is light of that patch alone, at the full size and at each smaller level of detail.
TEST(LightAtlas, ChartsDoNotLeak) {
  SyntheticScene scene;
  scene.scene.materials = {{"grey", Rgb::Constant(0.5), Rgb::Zero()}};
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    const double light = i % 2 == 0 ? 1e4 : 1;
    const SyntheticSurface surface{0, 1, 0,
                                   [light](const Vec3&, const Vec3&) { return Rgb(Rgb::Constant(light)); }};
    AddParallelogram({2.0 * i, 0, 0}, {random.Uniform(0.2, 1.5), 0, 0},
                     {random.Uniform(-0.3, 0.3), random.Uniform(0.2, 1.5), 0}, surface, &random, &scene);
  }
  const LightAtlas atlas = MakeLightAtlas(scene.scene, scene.mesh, 512);
  RgbImage level = atlas.irradiance;
  for (int l = 0; l <= kAtlasLevels; ++l, level = Halved(level)) {
    for (const Chart& chart : atlas.layout.charts) {
      const float light = chart.patch % 2 == 0 ? 1e4F : 1.0F;
      for (const Vec3& corner : scene.scene.patches[static_cast<std::size_t>(chart.patch)].Vertices()) {
        const Eigen::Vector2d at = atlas.layout.PixelOf(chart, corner) / (1 << l);
        const int x = static_cast<int>(std::floor(at.x() - 0.5)),
                  y = static_cast<int>(std::floor(at.y() - 0.5));
        for (int dy = 0; dy < 2; ++dy)
          for (int dx = 0; dx < 2; ++dx) EXPECT_EQ(level.At(x + dx, y + dy).x, light) << "level " << l;
      }
    }
  }
}

// Where the charts' borders have no room, the message tells a size that has.
TEST(LightAtlas, TellsWhatIsLargeEnough) {
  const SyntheticScene room = MakeRoom(1);
  try {
    LayOutCharts(room.scene, 40);
    FAIL() << "37 charts do not fit";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("give --atlas 160"));
  }
  EXPECT_GT(LayOutCharts(room.scene, 160).pixels_per_metre, 0);
  EXPECT_TRUE(AtlasBytes("glb", {Scene(), IrradianceMesh(), {}, 1}, 16).starts_with("glTF"));
}

}  // namespace
}  // namespace penumbra
