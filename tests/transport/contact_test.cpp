// Irradiance beside and at the foot of things that stand on the receiver, as a limit from one side.

#include <gtest/gtest.h>

#include "solver/transport/points/point_irradiance.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// A wall on the plane z = 0, its foot along x from -1 to 1, leaning back by `dihedral` from the plane in
// front of it (y > 0); its front looks to y > 0.
Scene LeaningWall(double dihedral, double height) {
  Scene scene;
  const Vec3 up(0, height * std::cos(dihedral), height * std::sin(dihedral));
  const Vec3 a(-1, 0, 0), b(1, 0, 0);
  Add(scene, {b, a, a + up, b + up}, AddMaterial(scene, 0, 1));
  return scene;
}

// Beside the middle of the foot F is the half of (1 + cos dihedral) that a wall of any height tends to, from
// every direction of approach, at every orientation of the whole; the side decides, and so the result says.
TEST(Contact, MiddleOfTheFoot) {
  Random random(201);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double dihedral = random.Uniform(0.05, 3.0);
    const Motion motion = RandomMotion(random, 5);
    const Scene scene = Mapped(LeaningWall(dihedral, random.LogUniform(0.1, 10)), motion);
    const double angle = random.Uniform(0.01, 3.13);
    const ReceiverPoint at = Receiver(motion({random.Uniform(-0.9, 0.9), 0, 0}), motion.turn * Vec3::UnitZ(),
                                      motion.turn * Vec3(std::cos(angle), std::sin(angle), 0));
    const PointIrradianceResult front = Direct(scene, at);
    EXPECT_TRUE(front.one_sided);
    worst = std::max(worst, std::abs(front.irradiance[0] - (1 + std::cos(dihedral)) / 2));
    const PointIrradianceResult behind = Direct(scene, Receiver(at.position, at.normal, -at.approach));
    EXPECT_EQ(behind.irradiance[0], 0) << "behind the wall";
    EXPECT_EQ(Direct(scene, Receiver(at.position, at.normal)).irradiance[0], 0) << "without an approach";
  }
  std::printf("seed 201, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-12);  // roundings of 1e-15 m, seen across some tenths of a metre
}

// At the end of the foot of an upright wall F is what an approach at the angle phi to the foot sees of it:
// phi-dependent, phi / 2 pi for the right angle between foot and end.
TEST(Contact, EndOfTheFoot) {
  Random random(202);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const double phi = random.Uniform(0.01, 3.13);
    const Motion motion = RandomMotion(random, 5);
    const Scene scene = Mapped(LeaningWall(std::numbers::pi / 2, random.LogUniform(0.1, 10)), motion);
    // From the end at x = 1 the foot runs to -x; phi is the angle between the approach and the foot's
    // continuation.
    const ReceiverPoint at = Receiver(motion({1, 0, 0}), motion.turn * Vec3::UnitZ(),
                                      motion.turn * Vec3(std::cos(phi), std::sin(phi), 0));
    const PointIrradianceResult got = Direct(scene, at);
    EXPECT_TRUE(got.one_sided);
    worst = std::max(worst, std::abs(got.irradiance[0] - phi / (2 * std::numbers::pi)));
  }
  std::printf("seed 202, largest error %.2g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

// The limit is what the value tends to: 1e-9 along the approach it differs by some 1e-9, from lights that
// stand on the receiver, behind boxes that stand on it, at any orientation, in the middle and at the ends of
// feet.
TEST(Contact, LimitIsTheValueNearby) {
  Random random(203);
  double worst = 0;
  int one_sided = 0;
  for (int i = 0; i < 400; ++i) {
    Scene room;
    const std::int32_t dark = AddMaterial(room, 0.5, 0), bright = AddMaterial(room, 0, 1);
    AddBox(room, {-2, -2, 0}, {2, 2, 2}, true, {dark, bright, bright, dark, dark, dark});
    AddBox(room, {-0.5, -0.25, 0}, {0.5, 0.25, 0.75}, false, {dark, dark, dark, bright, dark, bright});
    const Motion motion = RandomMotion(random, 3);
    const Scene scene = Mapped(room, motion);
    const bool corner = random.Index(2) == 0;
    const double sx = random.Index(2) == 0 ? -1 : 1, sy = random.Index(2) == 0 ? -1 : 1;
    const Vec3 p = corner                 ? Vec3(0.5 * sx, 0.25 * sy, 0)
                   : random.Index(2) == 0 ? Vec3(0.5 * sx, random.Uniform(-0.24, 0.24), 0)
                                          : Vec3(random.Uniform(-0.49, 0.49), 0.25 * sy, 0);
    const double angle = random.Uniform(0, 2 * std::numbers::pi);
    const Vec3 approach(std::cos(angle), std::sin(angle), 0);
    // Nearly along a foot the value 1e-9 away is not near the limit: 1e-9 / sin^2 of the angle.
    if (std::min(std::abs(approach.x()), std::abs(approach.y())) < 0.1) continue;
    const Vec3 normal = motion.turn * Vec3::UnitZ();
    const PointIrradianceResult limit = Direct(scene, Receiver(motion(p), normal, motion.turn * approach));
    const PointIrradianceResult near = Direct(scene, Receiver(motion(p + 1e-9 * approach), normal));
    one_sided += limit.one_sided;
    // 1e-9 m out of a foot that is known to 1e-15 m is known to some 1e-7 in direction.
    EXPECT_NEAR(limit.irradiance[0], near.irradiance[0], 5e-7)
        << "case " << i << (corner ? " corner " : " foot ") << p.transpose() << " from "
        << approach.transpose();
    worst = std::max(worst, std::abs(limit.irradiance[0] - near.irradiance[0]));
  }
  std::printf("seed 203, largest difference %.2g, %d one-sided\n", worst, one_sided);
  EXPECT_GT(one_sided, 100);
}

// At the foot of a box on an uncut floor the side decides: dark from below the box, as bright as 1e-9 outside
// from the other side, whatever the direction of approach along one edge.
TEST(Contact, BoxOnUncutFloor) {
  Random random(204);
  for (int i = 0; i < 200; ++i) {
    Scene plain;
    const std::int32_t grey = AddMaterial(plain, 0.5, 0), bright = AddMaterial(plain, 0, 1);
    AddBox(plain, {-2, -2, 0}, {2, 2, 2}, true, {grey, bright, grey, grey, grey, grey});
    AddBox(plain, {-0.5, -0.5, 0}, {0.5, 0.5, 0.5}, false, grey);
    const Motion motion = RandomMotion(random, 3);
    const Scene scene = Mapped(plain, motion);
    const Vec3 p(0.5, random.Uniform(-0.45, 0.45), 0), normal = motion.turn * Vec3::UnitZ();
    const auto from = [&](double angle) {
      return Direct(scene,
                    Receiver(motion(p), normal, motion.turn * Vec3(std::cos(angle), std::sin(angle), 0)));
    };
    const PointIrradianceResult outside = from(0);
    EXPECT_TRUE(outside.one_sided);
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(from(random.Uniform(-1.5, 1.5)).irradiance[0], outside.irradiance[0], 1e-12) << i;
      EXPECT_EQ(from(std::numbers::pi + random.Uniform(-1.5, 1.5)).irradiance[0], 0) << i;
    }
    const auto at_distance = [&](double d) {
      return Direct(scene, Receiver(motion(p + Vec3(d, 0, 0)), normal)).irradiance[0];
    };
    EXPECT_NEAR(at_distance(1e-9), outside.irradiance[0], 5e-7) << i;
    EXPECT_EQ(at_distance(-1e-9), 0) << i;
  }
}

// Away from everything that touches the receiver the approach decides nothing.
TEST(Contact, ApproachDecidesNothingInTheOpen) {
  Random random(205);
  for (int i = 0; i < 300; ++i) {
    const Scene scene = FurnishedRoom(random, 4);
    // Off the grid of the furniture's coordinates.
    const Vec3 p(random.Uniform(0.01, 0.24) + 0.25 * random.Index(16),
                 random.Uniform(0.01, 0.24) + 0.25 * random.Index(16), 0);
    const Vec3 approach(random.Uniform(-1, 1), random.Uniform(-1, 1), 0);
    const PointIrradianceResult with = Direct(scene, Receiver(p, Vec3::UnitZ(), approach));
    EXPECT_FALSE(with.one_sided);
    EXPECT_EQ(with.irradiance[0], Direct(scene, Receiver(p, Vec3::UnitZ())).irradiance[0]);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
