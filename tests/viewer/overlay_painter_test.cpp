// Lines are seen where nothing stands before them, and where they lie on a surface, from any angle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "display/camera.h"
#include "display/two_pass_display.h"
#include "display/viewer/leaf_mesh.h"
#include "display/viewer/overlay_painter.h"
#include "solver/base/random.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

constexpr int kWidth = 160, kHeight = 120;

struct Drawn {
  explicit Drawn(const Camera& camera)
      : scene(viewer_test::ShadowScene()),
        forest(*scene),
        mesh(LeafMesh(forest, std::vector<Rgb>(forest.size(), Rgb::Zero()))),
        display(*scene, mesh),
        depth(MakePixelRays(camera, kWidth, kHeight), display.Render(camera, kWidth, kHeight), mesh) {
    picture = display.ToneMap({1, false}).screen;
  }
  // How many pixels are rather red.
  std::size_t Red(const OverlayDrawing& drawing) const {
    Srgb8Image painted = picture;
    PaintOverlay(drawing, depth, &painted);
    std::size_t count = 0;
    for (std::size_t i = 0; i < painted.pixels.size(); i += 3)
      count += painted.pixels[i] > 128 && painted.pixels[i + 1] < 100 ? 1 : 0;
    return count;
  }

  std::shared_ptr<const Scene> scene;
  ElementForest forest;
  IrradianceMesh mesh;
  TwoPassDisplay display;
  DepthMap depth;
  Srgb8Image picture;
};

OverlayDrawing RedLine(const Vec3& a, const Vec3& b) {
  OverlayDrawing drawing;
  drawing.Line(a, b, colour::kRed, 2.0F);
  return drawing;
}

TEST(OverlayPainter, HidesWhatStandsBehindAFace) {
  const Drawn drawn({"", Vec3(0.02, 0.01, 3), Vec3(0, 0, 0), Vec3::UnitY(), 60});
  // Above the floor it is seen, below it hidden, whatever the distance.
  for (const double height : {0.9, 0.1, 1e-3})
    EXPECT_GT(drawn.Red(RedLine(Vec3(-0.9, 0.7, height), Vec3(0.9, 0.7, height))), 40U);
  for (const double height : {-0.05, -1.0})
    EXPECT_EQ(drawn.Red(RedLine(Vec3(-0.8, 0.7, height), Vec3(0.8, 0.7, height))), 0U);
}

TEST(OverlayPainter, ShowsLinesOnSurfacesAtAnyAngle) {
  for (const double height : {3.0, 0.6, 0.1, 0.02}) {
    const Drawn drawn({"", Vec3(0, -2.5, height), Vec3(0, 0, 0), Vec3::UnitZ(), 50});
    Random random(3);
    for (int i = 0; i < 40; ++i) {
      const Vec3 a(random.Uniform() * 1.8 - 0.9, random.Uniform() * 1.8 - 0.9, 0);
      const Vec3 b(random.Uniform() * 1.8 - 0.9, random.Uniform() * 1.8 - 0.9, 0);
      const ScreenPoint p = Project(drawn.depth.rays(), a), q = Project(drawn.depth.rays(), b);
      const double length = std::max(std::abs(p.x - q.x), std::abs(p.y - q.y));
      if (length < 10) continue;
      EXPECT_GT(static_cast<double>(drawn.Red(RedLine(a, b))), 0.9 * length) << "height " << height;
    }
  }
}

TEST(OverlayPainter, CutsLinesThatReachBehindTheEye) {
  const Drawn drawn({"", Vec3(0, 0, 0.5), Vec3(0, 0.9, 0.5), Vec3::UnitZ(), 60});
  // Along the view, just below the eye, from far behind to far ahead: down the middle of the picture.
  const std::size_t red = drawn.Red(RedLine(Vec3(0, -50, 0.45), Vec3(0, 50, 0.45)));
  EXPECT_GT(red, 30U);
  EXPECT_LT(red, 3U * kHeight);
}

TEST(OverlayPainter, PaintsTheSameForAnyBandAndPicksWhatItPaints) {
  const Drawn drawn({"", Vec3(0.02, 0.01, 3), Vec3(0, 0, 0), Vec3::UnitY(), 60});
  OverlayDrawing drawing;
  drawing.Line(Vec3(-0.9, -0.9, 0), Vec3(0.9, 0.9, 0), colour::kRed, 2.0F, {SelectionKind::kLink, 5});
  drawing.Line(Vec3(-0.9, 0.9, -1), Vec3(0.9, -0.9, -1), colour::kRed, 2.0F, {SelectionKind::kLink, 6});
  const ScreenPoint on = Project(drawn.depth.rays(), Vec3(0.8, 0.8, 0));
  EXPECT_EQ(PickLine(drawing, drawn.depth, on.x + 1, on.y), (Selection{SelectionKind::kLink, 5}));
  // The other line is hidden, and there is none elsewhere.
  const ScreenPoint hidden = Project(drawn.depth.rays(), Vec3(0.6, -0.6, -1));
  EXPECT_FALSE(PickLine(drawing, drawn.depth, hidden.x, hidden.y));
  EXPECT_FALSE(PickLine(drawing, drawn.depth, on.x + 3 * kPickDistance, on.y));
}

TEST(OverlayPainter, FillsTrianglesOnceWhereTheyShareAnEdge) {
  const Drawn drawn({"", Vec3(0.02, 0.01, 3), Vec3(0, 0, 0), Vec3::UnitY(), 60});
  const Polygon3 square = {Vec3(-0.9, 0.5, 0.2), Vec3(0.9, 0.5, 0.2), Vec3(0.9, 0.9, 0.2),
                           Vec3(-0.9, 0.9, 0.2)};
  OverlayDrawing drawing;
  drawing.Fill(square, colour::kRed, 1);
  double area = 0;
  std::vector<Vec2> corner;
  for (const Vec3& v : square) {
    const ScreenPoint p = Project(drawn.depth.rays(), v);
    corner.emplace_back(p.x, p.y);
  }
  area = std::abs(SignedArea(corner));
  const double perimeter = 2 * ((corner[1] - corner[0]).norm() + (corner[2] - corner[1]).norm());
  EXPECT_NEAR(static_cast<double>(drawn.Red(drawing)), area, perimeter / 2);
}

}  // namespace
}  // namespace penumbra::viewer
