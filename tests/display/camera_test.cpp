#include "display/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "display/glm_conversion.h"
#include "solver/base/check.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

Vec3 RandomVector(Random& random, double size) {
  return size * Vec3(random.Uniform(-1, 1), random.Uniform(-1, 1), random.Uniform(-1, 1));
}

// The middle of the picture shows look_at, pixels are square, up is up, and the vertical field of view is
// what the camera says.
TEST(MakePixelRays, SpansTheFieldOfView) {
  Random random(1);
  double worst = 0;
  for (int round = 0; round < 1000; ++round) {
    Camera camera;
    camera.eye = RandomVector(random, 5);
    camera.look_at = RandomVector(random, 5);
    camera.up = RandomVector(random, 1);
    camera.vertical_fov = random.Uniform(1, 175);
    const int width = 1 + static_cast<int>(random.Index(2000)),
              height = 1 + static_cast<int>(random.Index(2000));
    const PixelRays rays = MakePixelRays(camera, width, height);
    const Vec3 view = (camera.look_at - camera.eye).normalized();
    const auto direction = [&](double x, double y) { return ToEigen(rays.Direction(x, y)); };
    const Vec3 top = direction(0.5 * width, 0).normalized(),
               bottom = direction(0.5 * width, height).normalized();
    const Vec3 dx = ToEigen(rays.dx), dy = ToEigen(rays.dy);
    const double angle = std::atan2(top.cross(bottom).norm(), top.dot(bottom)) * 180 / std::numbers::pi;
    worst = std::max({worst, (direction(0.5 * width, 0.5 * height) - view).norm(),
                      std::abs(angle / camera.vertical_fov - 1), std::abs(dx.norm() / dy.norm() - 1),
                      std::abs(dx.dot(view)), std::abs(dx.normalized().dot(dy.normalized()))});
    EXPECT_LT(dy.dot(camera.up), 0);
    EXPECT_GT(dx.dot(view.cross(camera.up)), 0);
  }
  std::cout << "largest error: " << worst << "\n";
  EXPECT_LT(worst, 1e-12);
}

// An up that is zero or along the view is replaced, so that every view has its picture.
TEST(MakePixelRays, ReplacesAnUpAlongTheView) {
  for (const Vec3& view : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(0, 1, 0), Vec3(1, 2, 3)})
    for (const Vec3& up : {view, Vec3(-view), Vec3(Vec3::Zero()), Vec3(1e-9 * view), Vec3(1e200 * view)}) {
      const PixelRays rays = MakePixelRays({"", {1, 1, 1}, Vec3(1, 1, 1) + view, up, 45}, 10, 10);
      EXPECT_TRUE(ToEigen(rays.corner).allFinite() && ToEigen(rays.dx).allFinite() &&
                  ToEigen(rays.dy).allFinite());
      EXPECT_NEAR(glm::length(rays.dx), glm::length(rays.dy), 1e-12);
      EXPECT_GT(glm::length(rays.dx), 0.01);
      if (view.x() == 0 && view.y() == 0) {
        EXPECT_LT(rays.dy.y, 0) << "y is up where the view runs along z";
      } else {
        EXPECT_LT(rays.dy.z, 0) << "z is up";
      }
    }
}

// Looking far away, or at a point just before the eye, is no reason to lose digits.
TEST(MakePixelRays, BearsAnyDistanceOfThePointLookedAt) {
  const PixelRays one = MakePixelRays({"", Vec3::Zero(), {1, 2, 3}, Vec3::UnitZ(), 45}, 4, 3);
  for (const double scale : {1e-300, 1e-160, 1e160, 1e300}) {
    const PixelRays rays = MakePixelRays({"", Vec3::Zero(), scale * Vec3(1, 2, 3), Vec3::UnitZ(), 45}, 4, 3);
    EXPECT_LT(glm::length(rays.corner - one.corner), 1e-14) << scale;
  }
}

// A projection undoes what the rays do: a point of the ray through (x, y) is seen at (x, y), at its depth.
TEST(MakeProjection, UndoesTheRays) {
  Random random(3);
  double worst = 0;
  for (int round = 0; round < 1000; ++round) {
    const PixelRays rays = MakePixelRays({"", RandomVector(random, 5), RandomVector(random, 5),
                                          RandomVector(random, 1), random.Uniform(5, 120)},
                                         640, 480);
    const double x = random.Uniform(0, 640), y = random.Uniform(0, 480), depth = random.LogUniform(1e-3, 1e3);
    const glm::dvec3 p = MakeProjection(rays)(depth * rays.Direction(x, y));
    worst = std::max({worst, std::abs(p.x / p.z - x), std::abs(p.y / p.z - y), std::abs(p.z / depth - 1)});
  }
  std::cout << "largest error: " << worst << " pixels\n";
  EXPECT_LT(worst, 1e-9);  // some thousands of roundings: pixels are small beside the view
}

// A camera that cannot see is refused with a line that names it.
TEST(ValidateCamera, RefusesCamerasThatCannotSee) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Camera good{"good", {0, 0, 1}, {1, 0, 0}, Vec3::UnitZ(), 45};
  EXPECT_NO_THROW(ValidateCamera(good));
  std::vector<Camera> bad(9, good);
  bad[0].look_at = bad[0].eye;
  bad[1].eye.x() = nan;
  bad[2].look_at.y() = inf;
  bad[3].up.z() = nan;
  bad[4].vertical_fov = 0;
  bad[5].vertical_fov = 180;
  bad[6].vertical_fov = nan;
  bad[7].vertical_fov = -45;
  // Their difference is beyond binary64.
  bad[8].eye.x() = -1.5e308;
  bad[8].look_at.x() = 1.5e308;
  for (Camera& camera : bad) {
    camera.name = "odd";
    try {
      MakePixelRays(camera, 10, 10);
      ADD_FAILURE() << "camera " << &camera - bad.data();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("camera 'odd': error: "), std::string::npos) << error.what();
    }
  }
}

// The camera for scenes without one has all of the scene's box in any picture at least as wide as high.
TEST(FrameScene, ShowsAllOfTheBox) {
  Random random(2);
  for (int round = 0; round < 100; ++round) {
    const double size = random.LogUniform(1e-3, 1e3);
    const Vec3 low = RandomVector(random, 10 * size);
    const Vec3 extent = size * Vec3(random.Uniform(), random.Uniform(), random.Uniform());
    Scene scene;
    scene.materials.resize(1);
    const Vec3 x = extent.x() * Vec3::UnitX(), y = extent.y() * Vec3::UnitY(), z = extent.z() * Vec3::UnitZ();
    scene.patches.push_back(MakePatch(std::array<Vec3, 3>{low, low + x, low + y + z}, 0, 0, {}));
    const PixelRays rays = MakePixelRays(FrameScene(scene), 300, 300);
    const Projection to_picture = MakeProjection(rays);
    double widest = 0;
    for (int i = 0; i < 8; ++i) {
      const Vec3 corner =
          low + (i & 1 ? x : Vec3::Zero()) + (i & 2 ? y : Vec3::Zero()) + (i & 4 ? z : Vec3::Zero());
      const glm::dvec3 p = to_picture(ToGlm(corner) - rays.eye);
      ASSERT_GT(p.z, 0);
      widest = std::max({widest, std::abs(p.x / p.z - 150), std::abs(p.y / p.z - 150)});
    }
    EXPECT_LE(widest, 150);
    EXPECT_GT(widest, 120) << "no farther away than it must be";
  }
}

// An empty scene and one of a single point's extent still have a camera that can see.
TEST(FrameScene, FramesAnEmptyScene) { EXPECT_NO_THROW(ValidateCamera(FrameScene(Scene{}))); }

}  // namespace
}  // namespace penumbra
