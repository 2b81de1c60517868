#include "display/two_pass_display.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "display/glm_conversion.h"
#include "solver/base/parallel.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

// A picture that goes to the screen tile by tile is, to the byte, the one that is evaluated and then
// tone-mapped: any size, lights and background in view, dithered or not, on any number of threads.
TEST(TwoPassDisplay, ScreensTileByTileAreTheSame) {
  const SyntheticScene room = MakeRoom(5);
  TwoPassDisplay whole(room.scene, room.mesh), tiled(room.scene, room.mesh);
  const Camera outside{"outside", {14, -9, 7}, {3, 2.5, 1.5}, Vec3::UnitZ(), 40};
  for (const Camera& camera : {RoomCamera(), outside})
    for (const auto& [width, height] : {std::pair{1, 1}, {64, 64}, {131, 67}, {2, 300}, {200, 150}})
      for (const ShadingMode mode : {ShadingMode::kRadiosity, ShadingMode::kReflectance})
        for (const bool dither : {false, true})
          for (const int threads : {1, 2}) {
            SetThreadCount(threads);
            const ToneMapping tone{mode == ShadingMode::kRadiosity ? 1.0 / 30 : 1.0, dither};
            whole.Render(camera, width, height, mode);
            const Srgb8Image& want = whole.ToneMap(tone).screen;
            const Srgb8Image& got = tiled.RenderScreen(camera, width, height, mode, tone).screen;
            ASSERT_EQ(got.width, width);
            ASSERT_EQ(got.height, height);
            ASSERT_EQ(got.pixels, want.pixels) << width << " x " << height << ' ' << dither;
          }
  SetThreadCount(0);
}

// The picture shows the field that the interpolants hold, x reflectance: at every pixel the quadratic field
// at the ray's point, to the floats' rounding.
TEST(TwoPassDisplay, ShowsTheFieldOfItsInterpolants) {
  const SyntheticScene room = MakeRoom(7);
  TwoPassDisplay display(room.scene, room.mesh);
  constexpr int kWidth = 150, kHeight = 110;
  const RenderedFrame& frame = display.Render(RoomCamera(), kWidth, kHeight);
  const PixelRays rays = MakePixelRays(RoomCamera(), kWidth, kHeight);
  double worst = 0;
  int emitters = 0;
  for (std::size_t i = 0; i < frame.triangle.size(); ++i) {
    ASSERT_NE(frame.triangle[i], kNoTriangle);
    const PatchId id = room.mesh.triangles[frame.triangle[i]].patch;
    const Patch& patch = room.scene.patches[static_cast<std::size_t>(id)];
    const Material& material = room.scene.MaterialOf(id);
    const Vec3 eye = ToEigen(rays.eye),
               along = ToEigen(rays.Direction(static_cast<double>(i % kWidth) + 0.5,
                                              static_cast<double>(i / kWidth) + 0.5));
    const Vec3 p = eye + patch.normal.dot(patch.vertex[0] - eye) / patch.normal.dot(along) * along;
    const Rgb want = QuadraticField(p, patch.normal) * material.reflectance + material.emittance;
    for (std::size_t c = 0; c < 3; ++c)
      worst = std::max(
          worst,
          std::abs(static_cast<double>(frame.linear.channel[c][i]) / want[static_cast<Eigen::Index>(c)] - 1));
    EXPECT_EQ(frame.kind[i] == PixelKind::kEmitter, (material.emittance > 0).any());
    emitters += frame.kind[i] == PixelKind::kEmitter;
  }
  EXPECT_GT(emitters, 0);
  std::cout << "largest relative difference " << worst << "\n";
  EXPECT_LT(worst, 2e-5);
}

}  // namespace
}  // namespace penumbra
