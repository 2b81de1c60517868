#include "display/opengl_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "display/two_pass_display.h"
#include "solver/base/check.h"
#include "solver/base/random.h"
#include "tests/display/synthetic_room.h"

namespace penumbra {
namespace {

constexpr int kViewWidth = 320, kViewHeight = 240;

// The passes of the graphics system; null where there is none.
std::unique_ptr<Passes> TryOpenGl(const IrradianceMesh& mesh, OpenGlCoordinates coordinates) {
  try {
    return OpenGlPasses(mesh, coordinates);
  } catch (const InputError& error) {
    std::cout << error.what() << "\n";
    return nullptr;
  }
}

struct Difference {
  int same = 0, edges = 0;  // pixels that show the same triangle, and others at edges
  int inside = 0;           // that show another one far from any edge
  double radiosity = 0;     // the largest difference, relative, where triangles are the same
  double coordinate = 0;
};

// Whether the picture shows more than one triangle around the pixel.
bool IsEdge(const RenderedFrame& frame, int x, int y) {
  const auto id = [&](int i, int j) { return frame.triangle[frame.linear.Index(i, j)]; };
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, frame.height - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, frame.width - 1); ++i)
      if (id(i, j) != id(x, y)) return true;
  return false;
}

Difference Compare(const RenderedFrame& a, const RenderedFrame& b) {
  Difference difference;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = a.linear.Index(x, y);
      if (a.triangle[i] != b.triangle[i]) {
        ++(IsEdge(b, x, y) ? difference.edges : difference.inside);
        continue;
      }
      ++difference.same;
      if (a.triangle[i] == kNoTriangle) continue;
      difference.coordinate = std::max({difference.coordinate, static_cast<double>(std::abs(a.s[i] - b.s[i])),
                                        static_cast<double>(std::abs(a.t[i] - b.t[i]))});
      for (std::size_t c = 0; c < 3; ++c)
        difference.radiosity =
            std::max(difference.radiosity, std::abs(static_cast<double>(a.linear.channel[c][i]) /
                                                        static_cast<double>(b.linear.channel[c][i]) -
                                                    1));
    }
  return difference;
}

// Both back ends draw the same picture: at all pixels but some at edges the same triangle, and radiosity to
// 1e-4 of itself; from inside, outside, a hand's breadth off a wall, and with triangles, small and large,
// that reach behind the eye.
TEST(OpenGlPasses, AgreeWithTheRasteriser) {
  for (const int cells : {1, 6}) {
    const SyntheticScene room = MakeRoom(cells);
    std::unique_ptr<Passes> passes = TryOpenGl(room.mesh, OpenGlCoordinates::kFloat);
    if (!passes) GTEST_SKIP() << "no OpenGL here";
    TwoPassDisplay opengl(room.scene, room.mesh, std::move(passes)), software(room.scene, room.mesh);
    std::vector<Camera> cameras = {RoomCamera(),
                                   {"outside", {14, -9, 7}, {3, 2.5, 1.5}, Vec3::UnitZ(), 30},
                                   {"corner", {0.01, 0.01, 0.01}, {6, 5, 2}, Vec3::UnitZ(), 120},
                                   {"floor", {0.5, 2, 1e-3}, {6, 2.5, 1e-3}, Vec3::UnitZ(), 60}};
    Random random(3);
    for (int i = 0; i < 8; ++i)
      cameras.push_back({"random " + std::to_string(i),
                         {random.Uniform(0.01, 1), random.Uniform(0.01, 1), random.Uniform(0.01, 1)},
                         {random.Uniform(1, 6), random.Uniform(1, 5), random.Uniform(0, 3)},
                         Vec3::UnitZ(),
                         random.Uniform(20, 150)});
    for (const Camera& camera : cameras) {
      const Difference difference = Compare(opengl.Render(camera, kViewWidth, kViewHeight),
                                            software.Render(camera, kViewWidth, kViewHeight));
      std::cout << camera.name << ", " << cells << " cells: " << difference.edges
                << " pixels at edges show another triangle; radiosity within " << difference.radiosity
                << ", coordinates within " << difference.coordinate << "\n";
      EXPECT_EQ(difference.inside, 0);
      EXPECT_LT(difference.edges, difference.same / 500);
      EXPECT_LT(difference.radiosity, 1e-4);
    }
    // Screens, too: OpenGL's pictures go the same way from there.
    const ToneMapping tone{1.0 / 30, true};
    const Srgb8Image& screen =
        opengl.RenderScreen(RoomCamera(), kViewWidth, kViewHeight, ShadingMode::kRadiosity, tone).screen;
    const Srgb8Image& want =
        software.RenderScreen(RoomCamera(), kViewWidth, kViewHeight, ShadingMode::kRadiosity, tone).screen;
    std::size_t different = 0;
    for (std::size_t i = 0; i < want.pixels.size(); ++i) different += screen.pixels[i] != want.pixels[i];
    EXPECT_LT(different, want.pixels.size() / 100);
  }
}

// The thesis's texture of 8 bits gives coordinates within one of its 256 texels, and no better than half of
// one.
TEST(OpenGlPasses, TheTextureHasEightBits) {
  const SyntheticScene room = MakeRoom(6);
  std::unique_ptr<Passes> passes = TryOpenGl(room.mesh, OpenGlCoordinates::kTexture);
  if (!passes) GTEST_SKIP() << "no OpenGL here";
  TwoPassDisplay opengl(room.scene, room.mesh, std::move(passes)), software(room.scene, room.mesh);
  const Difference difference = Compare(opengl.Render(RoomCamera(), kViewWidth, kViewHeight),
                                        software.Render(RoomCamera(), kViewWidth, kViewHeight));
  std::cout << "radiosity within " << difference.radiosity << ", coordinates within " << difference.coordinate
            << "\n";
  EXPECT_LT(difference.coordinate, 1.05 / 256);
  EXPECT_GT(difference.coordinate, 0.45 / 256);
}

}  // namespace
}  // namespace penumbra
