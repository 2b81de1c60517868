#include "solver/geometry/region_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "solver/base/random.h"
#include "solver/geometry/convex_clip.h"

namespace penumbra {
namespace {

Polygon2 Rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

double AreaOf(const RegionDifference& difference) {
  double sum = 0;
  for (const auto& t : difference.triangles) {
    const double area = SignedArea(
        std::array{difference.vertices[t[0]], difference.vertices[t[1]], difference.vertices[t[2]]});
    EXPECT_GT(area, 0);
    sum += area;
  }
  return sum;
}

Polygon2 Turned(Polygon2 polygon, double angle, const Vec2& shift) {
  for (Vec2& p : polygon)
    p = Vec2(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
             std::sin(angle) * p.x() + std::cos(angle) * p.y()) +
        shift;
  return polygon;
}

TEST(RegionDifference, CutsThatNearlyCoincideWithTheOutline) {
  // A room's floor less strips that are off by up to the reach has no area left, nor slivers.
  Random random(37);
  for (int trial = 0; trial < 2000; ++trial) {
    const double reach = random.LogUniform(1e-12, 1e-3), angle = random.Uniform(0, 7);
    const Vec2 shift(random.Uniform(-1, 1), random.Uniform(-1, 1));
    const int strips = 1 + static_cast<int>(random.Index(7));
    std::vector<Polygon2> cuts;
    for (int i = 0; i < strips; ++i) {
      Polygon2 strip = Turned(Rectangle(3.0 * i / strips, 0, 3.0 * (i + 1) / strips, 2), angle, shift);
      for (Vec2& p : strip) p += 0.3 * reach * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
      cuts.push_back(strip);
    }
    RegionSubtractor subtractor;
    const Polygon2 floor = Turned(Rectangle(0, 0, 3, 2), angle, shift);
    EXPECT_TRUE(subtractor.Subtract(floor, cuts, {reach, Vec2::Zero()}).triangles.empty()) << trial;
  }
}

TEST(RegionDifference, AreaOfWhatIsLeft) {
  // A frame around a hole, whichever corners and edges the two have in common, exactly or to a rounding.
  Random random(41);
  double worst = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto place = [&] { return 0.25 * random.Index(5); };
    const double x = place(), y = place(), w = 0.25 + place(), h = 0.25 + place(),
                 angle = random.Uniform(0, 7);
    const double inside = std::min(1.0, x + w) - std::min(1.0, x),
                 high = std::min(1.0, y + h) - std::min(1.0, y);
    const Vec2 shift(random.Uniform(-1e3, 1e3), random.Uniform(-1, 1));
    RegionSubtractor subtractor;
    const RegionDifference left = subtractor.Subtract(
        Turned(Rectangle(0, 0, 1, 1), angle, shift),
        std::vector<Polygon2>(1, Turned(Rectangle(x, y, x + w, y + h), angle, shift)), {1e-9, Vec2::Zero()});
    worst = std::max(worst, std::abs(AreaOf(left) - (1 - inside * high)));
  }
  std::printf("largest error of the area: %.3g\n", worst);
  EXPECT_LE(worst, 4e-9);
}

TEST(ConvexClip, StripsAndDifferences) {
  // The narrowest strip around a rectangle is its shorter side; what two squares have in common and not adds
  // up to the first.
  Random random(43);
  for (int trial = 0; trial < 500; ++trial) {
    const double w = random.Uniform(0.01, 2), h = random.Uniform(0.01, 2), angle = random.Uniform(0, 7);
    const Polygon2 a = Turned(Rectangle(0, 0, w, h), angle, Vec2(1, 2));
    EXPECT_NEAR(NarrowestStrip(a).width, std::min(w, h), 1e-14);
    const Polygon2 b = Turned(Rectangle(0, 0, 1, 1), random.Uniform(0, 7), Vec2(random.Uniform(0, 2), 2));
    std::vector<Polygon2> left;
    SubtractConvex(a, b, 1e-12, left);
    double area = SignedArea(IntersectConvex(a, b));
    for (const Polygon2& part : left) area += SignedArea(part);
    EXPECT_NEAR(area, w * h, 1e-11);
  }
  EXPECT_EQ(NarrowestStrip(Polygon2{{0, 0}, {1, 0}}).width, 0);
  // The crossing of two edges near a corner, rounded, may be an edge of its own that runs backwards.
  EXPECT_EQ(NarrowestStrip(Polygon2{{0, 0}, {1, 0}, {1, 1}, {1, 1 - 1e-15}, {0, 1}}).width, 1);
}

}  // namespace
}  // namespace penumbra
