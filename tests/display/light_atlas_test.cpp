// Irradiance maps: each pixel holds the light of its own patch, at its own place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

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

// Gives each patch of the room a face with texture coordinates in a cell of its own of a grid, turned.
void GiveTextureCoordinates(Scene* scene) {
  constexpr int kCells = 7;
  constexpr double kTurned = 0.4, kSide = 0.55;
  for (std::size_t p = 0; p < scene->patches.size(); ++p) {
    Patch& patch = scene->patches[p];
    patch.faces = {static_cast<std::int32_t>(p)};
    Face& face = scene->faces.emplace_back();
    face.vertices.assign(patch.Vertices().begin(), patch.Vertices().end());
    const Vec2 cell(static_cast<double>(p % kCells), static_cast<double>(p / kCells));
    const std::array<Vec2, 4> unit = {Vec2(0, 0), Vec2(kSide, 0), Vec2(kSide, kSide), Vec2(0, kSide)};
    for (const Vec2& at : unit)
      face.uv.push_back((cell + Vec2(0.35, 0.1) + Eigen::Rotation2Dd(kTurned) * at) /
                        static_cast<double>(kCells));
  }
}

// By the scene's own texture coordinates, a pixel whose centre lies on a face has the light of the face at
// the place that the coordinates tell; padding around has the light of the nearest place; the rest is dark.
TEST(LightAtlas, FollowsTheTextureCoordinatesOfTheScene) {
  constexpr int kSize = 700;
  SyntheticScene room = MakeRoom(2);
  GiveTextureCoordinates(&room.scene);
  const LightAtlas atlas = MakeLightAtlas(room.scene, room.mesh, kSize, AtlasPlaces::kScene);
  double worst = 0;
  std::size_t inside = 0, padding = 0;
  for (std::size_t f = 0; f < room.scene.faces.size(); ++f) {
    const Face& face = room.scene.faces[f];
    // Faces are parallelograms, so that the map from texture coordinates to places is affine.
    Eigen::Matrix2d axes;
    axes << face.uv[1] - face.uv[0], face.uv[3] - face.uv[0];
    const Eigen::Matrix2d inverse = axes.inverse();
    for (int y = 0; y < kSize; ++y)
      for (int x = 0; x < kSize; ++x) {
        const std::size_t i = atlas.irradiance.Index(x, y);
        const Vec2 st = inverse * (Vec2((x + 0.5) / kSize, 1 - (y + 0.5) / kSize) - face.uv[0]);
        if ((st.array() < 0).any() || (st.array() > 1).any()) {
          padding += atlas.patch[i] == static_cast<PatchId>(f) ? 1 : 0;
          continue;
        }
        ++inside;
        ASSERT_EQ(atlas.patch[i], static_cast<PatchId>(f));
        const Vec3 point = face.vertices[0] + st.x() * (face.vertices[1] - face.vertices[0]) +
                           st.y() * (face.vertices[3] - face.vertices[0]);
        const Rgb field = QuadraticField(point, room.scene.patches[f].normal);
        worst = std::max(worst, std::abs(static_cast<double>(atlas.irradiance.channel[0][i]) / field[0] - 1));
      }
  }
  std::cout << "largest relative error " << worst << " at " << inside << " pixels\n";
  EXPECT_LT(worst, 1e-6);  // the precision of floats
  EXPECT_GT(inside, std::size_t{kSize * kSize / 8});
  EXPECT_GT(padding, inside / 10);
  EXPECT_EQ(std::count(atlas.patch.begin(), atlas.patch.end(), kNoPatch),
            static_cast<std::ptrdiff_t>(kSize * kSize - inside - padding));
}

// What texture coordinates cannot do is told: a face without them, tiles beyond the picture, and faces that
// share pixels. The backs of two-sided faces need none.
TEST(LightAtlas, RefusesTextureCoordinatesThatAreNoMap) {
  const auto message = [](const auto& change) -> std::string {
    SyntheticScene room = MakeRoom(1);
    GiveTextureCoordinates(&room.scene);
    change(room.scene);
    try {
      MakeLightAtlas(room.scene, room.mesh, 256, AtlasPlaces::kScene);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  using testing::HasSubstr;
  EXPECT_EQ(message([](Scene&) {}), "");
  EXPECT_THAT(message([](Scene& scene) { scene.faces[3].uv.clear(); }),
              HasSubstr("face 3 (counted from 0) has no texture coordinates"));
  EXPECT_THAT(message([](Scene& scene) { scene.faces[4].uv[1].x() += 1; }), HasSubstr("outside of 0 to 1"));
  EXPECT_THAT(message([](Scene& scene) { scene.faces[5].uv = scene.faces[4].uv; }),
              HasSubstr("faces 4 and 5 (counted from 0) overlap"));
  EXPECT_EQ(message([](Scene& scene) {
              const std::size_t count = scene.faces.size();
              for (std::size_t f = 0; f < count; ++f) {
                Face back = scene.faces[f];
                std::reverse(back.vertices.begin(), back.vertices.end());
                back.uv.clear();
                scene.faces.push_back(std::move(back));
              }
            }),
            "");
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
