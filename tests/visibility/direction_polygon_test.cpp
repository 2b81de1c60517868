// Cutting cones out of what a point sees.

#include "solver/visibility/point/direction_polygon.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/form_factor.h"

#include <gtest/gtest.h>

#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// A convex polygon at height 1 over the origin, as seen from it, from angles about the centre (x, y).
DirectionPolygon Round(double x, double y, double radius, std::span<const double> angles) {
  DirectionPolygon polygon;
  for (const double angle : angles)
    polygon.Add({x + radius * std::cos(angle), y + radius * std::sin(angle), 1});
  return polygon;
}

std::vector<double> EvenAngles(int n, double start = 0) {
  std::vector<double> angles;
  for (int i = 0; i < n; ++i) angles.push_back(start + i * 2 * std::numbers::pi / n);
  return angles;
}

double Left(const DirectionPolygon& of, const Cone& cone) {
  const Occluder occluder(cone);
  return Clipping().VisibleFormFactor(of, {&occluder, 1}, Vec3::UnitZ());
}

// What is cut out and what remains add up to the whole: what is left of the whole after the cone, and what is
// left of it after everything but the cone.
TEST(DirectionPolygon, CutAndRestAddUp) {
  Random random(501);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const DirectionPolygon whole =
        Round(random.Uniform(-1, 1), random.Uniform(-1, 1), random.LogUniform(0.1, 3),
              EvenAngles(3 + static_cast<int>(random.Index(4)), random.Uniform(0, 6)));
    const DirectionPolygon blocker =
        Round(random.Uniform(-1, 1), random.Uniform(-1, 1), random.LogUniform(0.1, 3),
              EvenAngles(3 + static_cast<int>(random.Index(2)), random.Uniform(0, 6)));
    const Cone cone = MakeCone({}, blocker, 1), inverse = MakeCone({}, whole, 1);
    // whole - blocker and blocker - whole leave the same overlap.
    const double overlap = FormFactor(whole, Vec3::UnitZ()) - Left(whole, cone);
    worst =
        std::max(worst, std::abs(overlap - (FormFactor(blocker, Vec3::UnitZ()) - Left(blocker, inverse))));
    EXPECT_GE(overlap, -1e-15);
  }
  std::printf("seed 501, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// Vertices that coincide, to the bit or to rounding, hide nothing from the test whether a cone covers a
// polygon.
TEST(DirectionPolygon, RepeatedVerticesDoNotHideOverlap) {
  Random random(502);
  for (int i = 0; i < 1000; ++i) {
    const DirectionPolygon plain = Round(0, 0, 1, EvenAngles(4, random.Uniform(0, 6)));
    const double shift = random.Index(2) == 0 ? 0 : 1e-16;
    DirectionPolygon repeated;
    for (int k = 0; k < 4; ++k) {
      repeated.Add(plain[k]);
      if (random.Index(2) == 0) repeated.Add(plain[k] + shift * RandomDirection(random));
    }
    const Cone larger = MakeCone({}, Round(0, 0, 2, EvenAngles(4)), 1);
    EXPECT_EQ(Classify(larger, repeated), Overlap::kAll);
    const Cone inner = MakeCone({}, Round(0, 0, 0.5, EvenAngles(3)), 1);
    EXPECT_EQ(Classify(inner, repeated), Overlap::kPart);
    EXPECT_NEAR(Left(repeated, inner), Left(plain, inner), 1e-15);
    // And as a blocker.
    const DirectionPolygon whole = Round(0, 0, 2, EvenAngles(4));
    EXPECT_NEAR(Left(whole, MakeCone({}, repeated, 1)), Left(whole, MakeCone({}, plain, 1)), 1e-15);
  }
}

// A piece with nearly as many vertices as it can hold survives a cone that cuts off several of them.
TEST(DirectionPolygon, ManyVerticesDoNotOverflow) {
  for (int n = 12; n <= DirectionPolygon::kCapacity; ++n) {
    // Vertices on the four axes with the others between: each edge of the square cuts off one of them.
    std::vector<double> angles;
    for (int i = 0; i < n; ++i) angles.push_back((i / 4 * 4.0 / n + i % 4) * std::numbers::pi / 2);
    std::sort(angles.begin(), angles.end());
    const DirectionPolygon whole = Round(0, 0, 1, angles);
    const double inset = 0.5 * (1 + std::cos(angles[1]));
    const DirectionPolygon square = Round(0, 0, std::sqrt(2.0) * inset, EvenAngles(4, std::numbers::pi / 4));
    const double left = Left(whole, MakeCone({}, square, 1));
    EXPECT_GT(left, 0);
    EXPECT_LT(left, 0.05 * FormFactor(whole, Vec3::UnitZ()));
  }
}

// What is above the horizon of a wall whose foot runs close by and almost within the horizon is half of the
// hemisphere, however the foot's ends lie above and below by little more than rounding: where the foot
// meets the horizon is then anybody's guess, but not on which side of the point.
TEST(DirectionPolygon, AFootInTheHorizonIsCutOnItsOwnSide) {
  Random random(504);
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Motion motion = RandomMotion(random, 2);
    const double away = random.LogUniform(1e-8, 1e-5), middle = random.Uniform(0.1, 0.9);
    // Seen by rounding alone, or by as much as the end of the foot is turned out of the plane.
    const double rise = random.LogUniform(1e-16, 1e-11) * (random.Index(2) == 0 ? 1 : -1);
    const Polygon3 wall = {motion({0, -middle, rise}), motion({0, 1 - middle, -rise}),
                           motion({0, 1 - middle, 1}), motion({0, -middle, 1})};
    ReceiverPoint at;
    at.position = motion({away, 0, 0});
    at.normal = motion.turn * Vec3::UnitZ();
    const double factor = FormFactor(ClipToHorizon(at, Seen(at, wall, true), 4), at.normal);
    worst = std::max(worst, std::abs(factor - 0.5));
  }
  // Of the half beyond the wall's ends and over its top: (away / 2)(1 + 1 / 0.1), at most; and the foot's
  // height as seen from the point, 1e-11 / 1e-8, where it lies farthest from the plane.
  std::printf("seed 504, largest error %.2g\n", worst);
  EXPECT_LE(worst, 2e-3);
}

// Cuts at a plane that contains an edge, but for rounding, cut nothing off.
TEST(DirectionPolygon, CoincidentPlanesCutNothing) {
  Random random(503);
  for (int i = 0; i < 1000; ++i) {
    const Motion motion = RandomMotion(random, 0);
    // Two walls side by side, each the other's neighbour behind a common edge.
    const Vec3 a = motion({0, 2, 0}), b = motion({0, 2, 1}), c = motion({1, 2, 1}), d = motion({1, 2, 0}),
               e = motion({-1, 2.5, 0}), f = motion({-1, 2.5, 1});
    DirectionPolygon one, two;
    for (const Vec3& v : {a, b, c, d}) one.Add(v);
    for (const Vec3& v : {e, f, b, a}) two.Add(v);
    EXPECT_EQ(Classify(MakeCone({}, one, 3), two), Overlap::kNone);
    EXPECT_EQ(Classify(MakeCone({}, two, 3), one), Overlap::kNone);
    EXPECT_EQ(Classify(MakeCone({}, one, 3), one), Overlap::kAll);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
