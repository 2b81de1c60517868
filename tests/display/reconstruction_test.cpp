// Light reconstructed from the vertices of leaves: what each method reproduces, and that Gouraud shading on
// the screen depends on the camera.

#include "display/reconstruction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {
namespace {

constexpr Reconstruction kAllKinds[] = {Reconstruction::kNodal, Reconstruction::kGouraudScreen,
                                        Reconstruction::kBilinear, Reconstruction::kBicubic};
constexpr int kPictureWidth = 200, kPictureHeight = 160;

// A floor of 2 x 2 m around the origin, or half of it, a triangle.
Scene Floor(std::size_t corners) {
  Scene scene;
  scene.materials.emplace_back();
  std::vector<Vec3> vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  vertices.resize(corners);
  scene.patches.push_back(MakePatch(vertices, 0, 0, {0}));
  return scene;
}

Camera From(const Vec3& eye, const Vec3& up) {
  Camera camera;
  camera.eye = eye;
  camera.look_at = Vec3::Zero();
  camera.up = up;
  return camera;
}

using Function = std::function<double(const Vec3&)>;

std::vector<VertexLight> LightOf(const ElementForest& forest, const Function& f) {
  VertexLight light;
  for (const ElementId leaf : forest.Leaves(0))
    for (std::size_t k = 0; k < forest[leaf].Corners().size(); ++k)
      light[forest[leaf].corner[k]] = Rgb::Constant(f(forest[leaf].vertex[k]));
  return {light};
}

double LargestError(Reconstruction kind, std::size_t corners, const Camera& camera, const Function& f) {
  const Scene scene = Floor(corners);
  ElementForest forest(scene);
  const ElementId first = forest.Subdivide(ElementForest::Root(0));
  forest.Subdivide(first + 2);  // with T-vertices
  const ReconstructedLight light(kind, forest, LightOf(forest, f));
  const RayShader shader = light.Shade(camera, kPictureWidth, kPictureHeight);
  double largest = 0;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const Vec3 p(-0.9 + 0.09 * i, -0.9 + 0.089 * j, 0);
      if (corners == 3 && p.y() > p.x()) continue;
      largest = std::max(largest, std::abs(shader({0, p})[0] - f(p)));
    }
  return largest;
}

double Linear(const Vec3& p) { return 5 + p.x() - 2 * p.y(); }

TEST(Reconstruction, LinearLightIsReproduced) {
  const Camera frontal = From({0, 0, 4}, {0, 1, 0}), tilted = From({1, -3, 2}, {0, 0, 1});
  for (const std::size_t corners : {3U, 4U})
    for (const Reconstruction kind : kAllKinds) {
      SCOPED_TRACE(static_cast<int>(kind));
      EXPECT_LE(LargestError(kind, corners, frontal, Linear), 1e-12);
      // On the screen, light that is linear in the picture is not linear on a surface that is seen obliquely.
      const double oblique = LargestError(kind, corners, tilted, Linear);
      if (kind == Reconstruction::kGouraudScreen)
        EXPECT_GT(oblique, 0.05);
      else
        EXPECT_LE(oblique, 1e-12);
    }
}

TEST(Reconstruction, OnlyBicubicPiecesReproduceQuadraticLight) {
  const Camera camera = From({0, 0, 4}, {0, 1, 0});
  const Function quadratic = [](const Vec3& p) {
    return 9 + p.x() * p.x() - 2 * p.y() * p.y() + p.x() * p.y();
  };
  EXPECT_LE(LargestError(Reconstruction::kBicubic, 4, camera, quadratic), 1e-12);
  EXPECT_GT(LargestError(Reconstruction::kBilinear, 4, camera, quadratic), 0.1);
}

// The light at the middle of a square whose corners are in turn 1 and 0: the mean of the edges that the row
// of pixels crosses. If the camera turns about its axis, these are other edges.
TEST(Reconstruction, GouraudShadingOnTheScreenSwims) {
  const Scene scene = Floor(4);
  const ElementForest forest(scene);
  const Function saddle = [](const Vec3& p) { return p.x() * p.y() > 0 ? 1.0 : 0.0; };
  const Camera upright = From({0, 0, 3}, {0, 1, 0}), turned = From({0, 0, 3}, {1, 1, 0});
  const RayPoint middle = {0, Vec3::Zero()};
  for (const Reconstruction kind : kAllKinds) {
    const ReconstructedLight light(kind, forest, LightOf(forest, saddle));
    const double before = light.Shade(upright, kPictureWidth, kPictureHeight)(middle)[0],
                 after = light.Shade(turned, kPictureWidth, kPictureHeight)(middle)[0];
    EXPECT_NEAR(before, 0.5, 1e-12);
    // The row passes through the corners (1, -1) and (-1, 1), where the light is 0.
    EXPECT_NEAR(after, kind == Reconstruction::kGouraudScreen ? 0 : 0.5, 1e-12);
  }
}

// A leaf that reaches behind the camera is cut; its light stays between those of its corners.
TEST(Reconstruction, LeavesBehindTheCameraAreCut) {
  const Scene scene = Floor(4);
  const ElementForest forest(scene);
  const ReconstructedLight light(Reconstruction::kGouraudScreen, forest,
                                 LightOf(forest, [](const Vec3& p) { return p.x() > 0 ? 3.0 : 1.0; }));
  const RayShader shader = light.Shade(From({-0.5, -0.5, 0.05}, {0, 0, 1}), kPictureWidth, kPictureHeight);
  for (const double x : {-0.3, -0.1, 0.0, 0.5, 0.9}) {
    const double shown = shader({0, {x, x, 0}})[0];
    EXPECT_GE(shown, 1);
    EXPECT_LE(shown, 3);
  }
}

}  // namespace
}  // namespace penumbra
