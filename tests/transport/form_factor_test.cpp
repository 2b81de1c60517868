// The form factor of a point to polygons: closed forms, invariants, closure. Nothing here is hidden.

#include <gtest/gtest.h>

#include "solver/scene/surface_points.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// F of a point to one polygon that shines with 1 W/m^2.
double FormFactorOf(const Polygon3& polygon, const ReceiverPoint& at) {
  Scene scene;
  Add(scene, polygon, AddMaterial(scene, 0, 1));
  return Direct(scene, at).irradiance[0];
}

// A w x h rectangle whose corner lies at height c over the point: Hamilton and Morgan's closed form.
double RectangleOverCorner(double w, double h, double c) {
  const double x = w / c, y = h / c, sx = std::sqrt(1 + x * x), sy = std::sqrt(1 + y * y);
  return (x / sx * std::atan(y / sx) + y / sy * std::atan(x / sy)) / (2 * std::numbers::pi);
}

// A random convex quadrilateral or triangle, no corner flatter than about a degree.
Polygon3 RandomPolygon(Random& random, double half) {
  const Frame frame = MakeFrame(RandomPoint(random, half), RandomDirection(random));
  const int n = 3 + static_cast<int>(random.Index(2));
  const double radius = random.LogUniform(0.1, 2), start = random.Uniform(0, 6);
  Polygon3 polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = start + (i + random.Uniform(-0.3, 0.3)) * 2 * std::numbers::pi / n;
    polygon.push_back(frame.FromPlane({radius * std::cos(angle), radius * std::sin(angle)}));
  }
  return polygon;
}

// A rectangle over its corner has the closed form's factor at all sizes. 1e-14: some twenty roundings of
// terms below 1, and the factor is never small against them.
TEST(FormFactor, RectangleOverCorner) {
  Random random(101);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const double w = random.LogUniform(0.1, 100), h = random.LogUniform(0.1, 100);
    const double c = random.LogUniform(0.1, 10);
    const double want = RectangleOverCorner(w, h, c);
    const double got =
        FormFactorOf({{0, 0, c}, {0, h, c}, {w, h, c}, {w, 0, c}}, Receiver(Vec3::Zero(), Vec3::UnitZ()));
    worst = std::max(worst, std::abs(got - want));
  }
  std::printf("seed 101, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// A wall that reaches below the horizon counts as much as the part of it that is above.
TEST(FormFactor, HorizonCutsWalls) {
  Random random(102);
  double worst = 0;
  for (int i = 0; i < 1000; ++i) {
    const double d = random.LogUniform(0.01, 10), w = random.LogUniform(0.1, 10);
    const double h = random.LogUniform(0.1, 10), below = random.LogUniform(1e-6, 10);
    const ReceiverPoint at = Receiver({0, d, 0}, Vec3::UnitZ());
    const double whole = FormFactorOf({{-w, 0, -below}, {-w, 0, h}, {w, 0, h}, {w, 0, -below}}, at);
    const double above = FormFactorOf({{-w, 0, 0}, {-w, 0, h}, {w, 0, h}, {w, 0, 0}}, at);
    // The closed form of a wall that stands on the receiver's plane.
    const double x = w / d, y = h / d, a = 1 / std::sqrt(1 + y * y);
    const double want = (std::atan(x) - a * std::atan(x * a)) / std::numbers::pi;
    worst = std::max({worst, std::abs(whole - above), std::abs(above - want)});
  }
  std::printf("seed 102, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-14);
}

// F lies in [0, 1], and the parts of a polygon add up to the whole, wherever it is cut. 1e-12: the points on
// the cut are rounded, which moves them by 1e-16 seen from no nearer than about 1e-3.
TEST(FormFactor, PartsAddUp) {
  Random random(103);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Polygon3 polygon = RandomPolygon(random, 2);
    const Vec3 position = RandomPoint(random, 2);
    const ReceiverPoint at = Receiver(position, RandomDirection(random));
    const std::size_t n = polygon.size();
    const double s = random.Uniform(0.05, 0.95), t = random.Uniform(0.05, 0.95);
    const Vec3 p = polygon[0] + s * (polygon[1] - polygon[0]);
    const Vec3 q = polygon[n - 2] + t * (polygon[n - 1] - polygon[n - 2]);
    const double whole = FormFactorOf(polygon, at);
    double parts = 0;
    if (n == 3) {
      parts = FormFactorOf({p, polygon[1], q}, at) + FormFactorOf({polygon[0], p, q, polygon[2]}, at);
    } else {
      parts =
          FormFactorOf({p, polygon[1], polygon[2], q}, at) + FormFactorOf({polygon[0], p, q, polygon[3]}, at);
    }
    EXPECT_GE(whole, 0);
    EXPECT_LE(whole, 1);
    worst = std::max(worst, std::abs(whole - parts));
  }
  std::printf("seed 103, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

// Turning, shifting and scaling everything changes nothing. 1e-11: shifts of 10 m round coordinates by 1e-15,
// seen from no nearer than about 1e-3; scaling by a power of two changes no bit.
TEST(FormFactor, RigidMotionAndScale) {
  Random random(104);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const Polygon3 polygon = RandomPolygon(random, 2);
    const Vec3 position = RandomPoint(random, 2), normal = RandomDirection(random);
    const Motion motion = RandomMotion(random, 10);
    const double scale = std::ldexp(1, static_cast<int>(random.Index(81)) - 40);
    Polygon3 moved, scaled;
    for (const Vec3& v : polygon) {
      moved.push_back(motion(v));
      scaled.push_back(scale * v);
    }
    const double plain = FormFactorOf(polygon, Receiver(position, normal));
    worst = std::max(worst,
                     std::abs(plain - FormFactorOf(moved, Receiver(motion(position), motion.turn * normal))));
    EXPECT_EQ(plain, FormFactorOf(scaled, Receiver(scale * position, normal)));
  }
  std::printf("seed 104, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-11);
}

// The faces of a closed convex box, turned anyhow, fill the hemisphere over every point of every face: their
// factors add up to 1. The floor's neighbours stand on its horizon but for rounding. 1e-12: points are no
// nearer than about 1e-4 to an edge, whose coordinates are rounded by 1e-16.
TEST(FormFactor, ClosedConvexBoxesSumToOne) {
  Random random(105);
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    Scene scene;
    const std::int32_t light = AddMaterial(scene, 0, 1);
    if (i % 2 == 0) {
      AddBox(scene, Vec3::Zero(), {random.LogUniform(0.3, 3), random.LogUniform(0.3, 3), 1}, true, light);
    } else {
      // A tetrahedron, fronts inwards.
      const std::array<Vec3, 4> v = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(random.Uniform(), 1, 0),
                                     Vec3(random.Uniform(), random.Uniform(), 1)};
      Add(scene, {v[0], v[1], v[2]}, light);
      Add(scene, {v[0], v[3], v[1]}, light);
      Add(scene, {v[1], v[3], v[2]}, light);
      Add(scene, {v[2], v[3], v[0]}, light);
    }
    scene = Mapped(scene, RandomMotion(random, 3));
    for (const SurfacePoint& p : SpreadPoints(scene, 20, 7 + static_cast<std::uint64_t>(i))) {
      const double sum = Direct(scene, Receiver(p.position, scene.patches[p.patch].normal)).irradiance[0];
      worst = std::max(worst, std::abs(sum - 1));
    }
  }
  std::printf("seed 105, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

}  // namespace
}  // namespace penumbra::scene_test
