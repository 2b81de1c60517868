#include "display/ray_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "display/glm_conversion.h"
#include "display/two_pass_display.h"
#include "mesh/interpolants/mesh_locator.h"
#include "solver/base/parallel.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

constexpr int kImageWidth = 160, kImageHeight = 120;

// A room whose walls are cut into triangles, some of them slivers a thousand times as long as wide.
SyntheticScene RoomWithSlivers() {
  SyntheticScene room = MakeRoom(9, 0.4);
  Random random(2);
  for (int i = 0; i < 40; ++i)
    AddParallelogram({0.5 + 0.1 * i, 0.3, 0.5}, {0.002, 0.1, 0.05}, {0, 2, 1.2}, {1, 3, 0.3, QuadraticField},
                     &random, &room);
  return room;
}

Camera Anywhere(Random& random) {
  return {"anywhere",
          {random.Uniform(3.2, 5.8), random.Uniform(0.2, 2.5), random.Uniform(0.8, 2.5)},
          {random.Uniform(0.5, 2.5), random.Uniform(1, 4.5), random.Uniform(0, 2)},
          Vec3::UnitZ(),
          random.Uniform(20, 90)};
}

// The two-pass display and rays show the same interpolants: wherever both look at the same triangle,
// radiosity agrees to 1e-4 of itself, in slivers too, and nearly everywhere they do.
TEST(RayDisplay, LerpShadeAgreesWithTheTwoPassDisplay) {
  const SyntheticScene room = RoomWithSlivers();
  TwoPassDisplay display(room.scene, room.mesh);
  RayDisplay rays(room.scene, LerpShade(room.scene, room.mesh), 1);
  const MeshLocator locator(room.scene, room.mesh);
  Random random(3);
  double worst = 0;
  int compared = 0, slivers = 0, elsewhere = 0, background = 0;
  for (int round = 0; round < 6; ++round) {
    const Camera camera = Anywhere(random);
    const RenderedFrame& frame = display.Render(camera, kImageWidth, kImageHeight);
    const SampledPicture& picture = rays.Render(camera, kImageWidth, kImageHeight, ExecutionContext());
    const PixelRays eye = MakePixelRays(camera, kImageWidth, kImageHeight);
    for (std::size_t i = 0; i < frame.triangle.size(); ++i) {
      const std::uint32_t id = frame.triangle[i];
      background += id == kNoTriangle;
      if (id == kNoTriangle) continue;
      const IrradianceMesh::Triangle& triangle = room.mesh.triangles[id];
      const Patch& patch = room.scene.patches[static_cast<std::size_t>(triangle.patch)];
      const Vec3 from = ToEigen(eye.eye),
                 along = ToEigen(eye.Direction(static_cast<double>(i % kImageWidth) + 0.5,
                                               static_cast<double>(i / kImageWidth) + 0.5));
      const Vec3 p = from + patch.normal.dot(patch.vertex[0] - from) / patch.normal.dot(along) * along;
      const auto at = locator.Find(triangle.patch, p);
      if (!at || at->triangle != id || picture.kind[i] != frame.kind[i]) {
        ++elsewhere;
        continue;
      }
      ++compared;
      slivers += patch.area < 0.03;
      for (std::size_t c = 0; c < 3; ++c) {
        const double want = static_cast<double>(picture.linear.channel[c][i]);
        worst = std::max(worst, std::abs(static_cast<double>(frame.linear.channel[c][i]) - want) / want);
      }
    }
  }
  std::cout << "largest relative difference " << worst << " of " << compared << " pixels, " << slivers
            << " of them in slivers; " << elsewhere << " at edges\n";
  EXPECT_EQ(background, 0);
  EXPECT_LT(worst, 1e-4);
  EXPECT_GT(slivers, 200);
  EXPECT_LT(elsewhere, compared / 200);
}

// A pixel's samples lie in it, the first in its centre, and a smooth field's mean over them nears its mean
// over the pixel: for a field linear in the picture, the centre's value.
TEST(RayDisplay, SpreadsSamplesOverThePixel) {
  SyntheticScene wall;
  wall.scene.materials = {{"grey", Rgb(0.5, 0.5, 0.5), Rgb::Zero()}};
  Random random(1);
  const IrradianceField linear = [](const Vec3& p, const Vec3&) { return Rgb(10 + p.x(), 10 + p.y(), 10); };
  AddParallelogram({-4, -4, 0}, {8, 0, 0}, {0, 8, 0}, {0, 3, 0.2, linear}, &random, &wall);
  const Camera down{"down", {0, 0, 3}, {0, 0, 0}, Vec3::UnitY(), 60};
  const RayShader shader = LerpShade(wall.scene, wall.mesh);
  RayDisplay one(wall.scene, shader, 1), many(wall.scene, shader, 64);
  const RgbImage centre = one.Render(down, 12, 9, ExecutionContext()).linear;
  const SampledPicture& picture = many.Render(down, 12, 9, ExecutionContext());
  ASSERT_EQ(picture.linear.width, 64 * 12);
  const RgbImage mean = Downsample(picture.linear, 64, 1);
  const double pixel = 2 * 3 * std::tan(std::numbers::pi / 6) / 9;  // [m] on the wall
  for (std::size_t i = 0; i < centre.PixelCount(); ++i)
    for (std::size_t c = 0; c < 2; ++c) {
      const double at_centre = static_cast<double>(centre.channel[c][i]);
      EXPECT_EQ(picture.linear.channel[c][64 * i], centre.channel[c][i]);
      // The recurrence's mean over 64 points is within 3 / 64 of the middle of the unit interval.
      EXPECT_NEAR(static_cast<double>(mean.channel[c][i]), at_centre, 0.5 * pixel * 3 / 64);
      double low = at_centre, high = at_centre;
      for (std::size_t k = 0; k < 64; ++k) {
        low = std::min(low, static_cast<double>(picture.linear.channel[c][64 * i + k]));
        high = std::max(high, static_cast<double>(picture.linear.channel[c][64 * i + k]));
      }
      EXPECT_GT(high - low, 0.5 * pixel * 0.9);
      EXPECT_LT(high - low, 0.5 * pixel * 1.0001);
    }
}

// Backs are passed through, whether the eye is inside the room or out; the picture does not depend on
// threads; a cancelled one ends early.
TEST(RayDisplay, SeesThroughBacksOnAnyThreads) {
  const SyntheticScene room = MakeRoom(2);
  RayDisplay rays(room.scene, LerpShade(room.scene, room.mesh), 2);
  const Camera outside{"outside", {14, -9, 7}, {3, 2.5, 1.5}, Vec3::UnitZ(), 30};
  SetThreadCount(1);
  const SampledPicture one = rays.Render(outside, kImageWidth, kImageHeight, ExecutionContext());
  SetThreadCount(2);
  const SampledPicture& two = rays.Render(outside, kImageWidth, kImageHeight, ExecutionContext());
  EXPECT_EQ(one.linear.channel, two.linear.channel);
  EXPECT_EQ(one.kind, two.kind);
  SetThreadCount(0);
  TwoPassDisplay display(room.scene, room.mesh);
  const RenderedFrame& frame = display.Render(outside, kImageWidth, kImageHeight);
  int different = 0;
  for (std::size_t i = 0; i < frame.kind.size(); ++i) different += frame.kind[i] != one.kind[2 * i];
  EXPECT_LT(different, 20);
  EXPECT_GT(std::count(frame.kind.begin(), frame.kind.end(), PixelKind::kSurface), 3000);

  ExecutionContext cancelled;
  cancelled.Cancel();
  const SampledPicture& none = rays.Render(outside, kImageWidth, kImageHeight, cancelled);
  EXPECT_EQ(std::count(none.kind.begin(), none.kind.end(), PixelKind::kBackground),
            2 * kImageWidth * kImageHeight);
}

}  // namespace
}  // namespace penumbra
