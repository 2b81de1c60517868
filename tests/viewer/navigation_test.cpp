// A moving camera is a rigid motion: what it turns about stays where it is in the picture, and distances
// stay.

#include <gtest/gtest.h>

#include <cmath>

#include "display/camera.h"
#include "display/glm_conversion.h"
#include "display/viewer/arcball.h"
#include "display/viewer/overlay_painter.h"
#include "display/viewer/walk.h"
#include "solver/base/random.h"

namespace penumbra::viewer {
namespace {

constexpr double kRounding = 1e-9;  // of a few hundred operations on numbers of order 1 to 100
constexpr PictureSize kSize{200, 150};
constexpr glm::dvec3 kUp(0, 0, 1);

Camera Somewhere() { return {"c", Vec3(3, -4, 2), Vec3(0.5, 0.2, 0.7), Vec3::UnitZ(), 50}; }

ScreenPoint Seen(const Camera& camera, const Vec3& point) {
  return Project(MakePixelRays(camera, kSize.width, kSize.height), point);
}

TEST(Arcball, KeepsTheDistanceToWhatItTurnsAbout) {
  const Camera before = Somewhere();
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const ArcballDrag drag(before, kSize, random.Uniform() * 200, random.Uniform() * 150,
                           static_cast<ArcballConstraint>(i % 3));
    const Camera after = drag.At(random.Uniform() * 200, random.Uniform() * 150);
    EXPECT_NEAR((after.eye - after.look_at).norm(), (before.eye - before.look_at).norm(), kRounding);
    EXPECT_EQ(after.look_at, before.look_at);
    EXPECT_NEAR(after.up.dot(after.eye - after.look_at), 0, kRounding);
  }
}

TEST(Arcball, GoesBackWhereItCameFrom) {
  const Camera before = Somewhere();
  const ArcballDrag drag(before, kSize, 80, 60, ArcballConstraint::kNone);
  EXPECT_LT((drag.At(80, 60).eye - before.eye).norm(), kRounding);
}

// What is nearer to the viewer than the centre follows the pointer.
TEST(Arcball, TurnsTheModelWithThePointer) {
  const Camera before = Somewhere();
  const Vec3 front = before.look_at + 0.1 * (before.eye - before.look_at);
  const ArcballDrag drag(before, kSize, 100, 75, ArcballConstraint::kNone);
  EXPECT_GT(Seen(drag.At(120, 75), front).x, Seen(before, front).x + 1);
  EXPECT_GT(Seen(drag.At(100, 95), front).y, Seen(before, front).y + 1);
}

TEST(Arcball, ConstrainedToSceneAxesTurnsAboutOneOfThem) {
  const Camera before = Somewhere();
  Random random(11);
  for (int i = 0; i < 50; ++i) {
    const ArcballDrag drag(before, kSize, random.Uniform() * 200, random.Uniform() * 150,
                           ArcballConstraint::kSceneAxes);
    const Camera after = drag.At(random.Uniform() * 200, random.Uniform() * 150);
    // A rotation about an axis keeps the coordinate along it.
    const Vec3 moved = (after.eye - after.look_at) - (before.eye - before.look_at);
    EXPECT_LT(moved.cwiseAbs().minCoeff(), kRounding);
  }
}

TEST(Arcball, WarpKeepsTheSizeOfWhatItLooksAt) {
  const Camera before = Somewhere();
  const PixelRays rays = MakePixelRays(before, kSize.width, kSize.height);
  const Vec3 beside = before.look_at + 0.3 * ToEigen(rays.dx).normalized();
  for (const double fov : {5.0, 20.0, 50.0, 120.0})
    EXPECT_NEAR(Seen(Warp(before, fov), beside).x, Seen(before, beside).x, 1e-7);
}

// However far the wheel is turned, the camera sees along the line that it saw along, and finds back.
TEST(Arcball, ZoomEndsWhereNumbersDo) {
  for (const Vec3& centre : {Somewhere().look_at, Vec3(Vec3::Zero())})
    for (const double notches : {-8000.0, -500.0, 500.0, 8000.0}) {
      Camera camera = Somewhere();
      camera.look_at = centre;
      const Vec3 before = (camera.eye - camera.look_at).normalized();
      for (int i = 0; i < 3; ++i) {
        camera = Zoom(camera, std::pow(1.1, notches));
        ASSERT_NO_THROW(ValidateCamera(camera)) << notches;
        EXPECT_LT(((camera.eye - camera.look_at).normalized() - before).norm(), 1e-5) << notches;
      }
      const double far = (camera.eye - camera.look_at).norm();
      EXPECT_NEAR((Zoom(camera, far / 5).eye - camera.look_at).norm(), 5, 1e-4);
    }
}

TEST(Arcball, PanMovesWhatItLooksAtByThePointersWay) {
  const Camera before = Somewhere();
  const Camera after = Pan(before, kSize, 12, -7);
  EXPECT_NEAR(Seen(after, before.look_at).x, Seen(before, before.look_at).x + 12, kRounding);
  EXPECT_NEAR(Seen(after, before.look_at).y, Seen(before, before.look_at).y - 7, kRounding);
}

TEST(Walk, FliesAheadAndLooksAround) {
  const Camera before = Somewhere();
  const Camera ahead = Fly(before, 2, 0, 0, kUp);
  EXPECT_NEAR((ahead.eye - before.eye).norm(), 2, kRounding);
  EXPECT_NEAR(Seen(before, ahead.eye).x, 100, kRounding * 100);

  const Camera turned = Look(before, 0.3, 0, kUp);
  EXPECT_NEAR((turned.look_at - turned.eye).norm(), (before.look_at - before.eye).norm(), kRounding);
  EXPECT_NEAR(turned.look_at.z(), before.look_at.z(), kRounding);
  EXPECT_LT(Seen(turned, before.look_at).x, 100);  // what was ahead is to the left now
  // A quarter turn four times is none.
  Camera round = before;
  for (int i = 0; i < 4; ++i) round = Look(round, std::acos(0.0), 0, kUp);
  EXPECT_LT((round.look_at - before.look_at).norm(), kRounding);
  // However far up one looks, up stays up.
  EXPECT_NO_THROW(ValidateCamera(Look(before, 0, 10, kUp)));
}

}  // namespace
}  // namespace penumbra::viewer
