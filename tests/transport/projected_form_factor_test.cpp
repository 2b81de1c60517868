// Hemicube, cubic tetrahedron and planes: sums of their cells, closed forms, and orders of convergence.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/transport/form_factors/cubic_tetrahedron.h"
#include "solver/transport/form_factors/hemicube.h"
#include "solver/transport/form_factors/item_buffer.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/form_factors/single_plane.h"
#include "solver/transport/form_factors/two_planes.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra {
namespace {

double Sum(const std::vector<PlaneGrid>& planes) {
  double sum = 0;
  for (const PlaneGrid& plane : planes) sum += SumOfDeltas(plane);
  return sum;
}

// A unit square in the plane z = 0 that looks up, and one of this side at height d that looks down, both
// about the z axis.
Scene FacingSquares(double side, double d) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::Add(scene, {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, 0);
  const double h = side / 2;
  scene_test::Add(scene, {{-h, h, d}, {h, h, d}, {h, -h, d}, {-h, -h, d}}, 0);
  return scene;
}

// Two unit squares that share an edge at a right angle.
Scene SquaresAtAnEdge() {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  scene_test::Add(scene, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0);
  return scene;
}

// The factor of the origin, turned by an angle, to the second patch.
double FromCentre(const Scene& scene, const std::vector<PlaneGrid>& planes, double angle) {
  Eye eye;
  eye.own = 0;
  eye.x = {std::cos(angle), std::sin(angle), 0};
  eye.y = {-std::sin(angle), std::cos(angle), 0};
  double factor = 0;
  const DrawnPolygon target{1, scene.patches[1].Vertices(), 0};
  for (const PlaneGrid& plane : planes)
    ItemBuffer(plane, scene, eye, {&target, 1}).AddFactors(1, {&factor, 1});
  return factor;
}

double RmsError(const Scene& scene, const std::vector<PlaneGrid>& planes, double truth) {
  constexpr int kTurns = 200;
  double squares = 0;
  for (int i = 0; i < kTurns; ++i) {
    const double error = FromCentre(scene, planes, 2 * std::numbers::pi * (i + 0.37) / kTurns) / truth - 1;
    squares += error * error / kTurns;
  }
  return std::sqrt(squares);
}

FormFactorEstimate Between(const Scene& scene, const std::string& method, std::size_t resolution) {
  LinkFormFactorOptions options;
  options.resolution = resolution;
  const auto parts = [&](PatchId p) {
    return AreaPart{p, {scene.patches[p].Vertices().begin(), scene.patches[p].Vertices().end()}};
  };
  const AreaPart from = parts(0), to = parts(1);
  return LinkFormFactorMethods().Make(method, options)->Between(scene, {&from, 1}, {&to, 1}, {}).value();
}

// Cells are squares whose form factors are known exactly: those of a hemicube and of a cubic tetrahedron add
// up to 1, those of a plane to what does not pass below its edges.
TEST(PlaneGrid, ExactCellsAddUpToOne) {
  for (const int n : {2, 5, 16, 101}) {
    EXPECT_NEAR(Sum(HemicubePlanes(n)), 1, 1e-12) << n;
    EXPECT_NEAR(Sum(CubicTetrahedronPlanes(n)), 1, 1e-12) << n;
    // The point below the centre of a square: 4 corners, each b / sqrt(1 + b^2) atan(...) / pi.
    const double b = kPlaneBreadth, s = b / std::sqrt(1 + b * b);
    const double seen = 4 / std::numbers::pi * s * std::atan(s);
    EXPECT_NEAR(Sum(SinglePlane(n)), seen, 1e-12) << n;
    EXPECT_NEAR(Sum(TwoPlanes(n)), seen, 1e-12) << n;
  }
  // For a broad plane, by expansion: (1/2 + 1/pi) / b^2.
  EXPECT_NEAR(1 - Sum(SinglePlane(8)), (0.5 + 1 / std::numbers::pi) / (kPlaneBreadth * kPlaneBreadth), 2e-5);
  EXPECT_NEAR(SumOfDeltas(HemicubePlanes(10)[0]), 0.5541264240, 1e-10);
  for (int side = 1; side < 5; ++side)
    EXPECT_NEAR(SumOfDeltas(HemicubePlanes(10)[static_cast<std::size_t>(side)]), 0.1114684, 1e-7);
}

// With the kernel at centres of cells, as printed, sums exceed 1 by amounts that were computed independently
// of this program, and that fall with the square of the resolution.
TEST(PlaneGrid, PrintedCellsExceedOne) {
  const std::map<int, double> hemicube = {{16, 2.1e-3}, {50, 2.2e-4}, {100, 5.42e-5}, {200, 1.36e-5}},
                              tetrahedron = {{16, 7.3e-3}, {72, 3.2e-4}, {142, 7.99e-5}, {282, 2.0e-5}};
  for (const auto& [n, excess] : hemicube)
    EXPECT_NEAR(Sum(HemicubePlanes(n, CellRule::kCentre)) - 1, excess, 0.03 * excess) << n;
  for (const auto& [n, excess] : tetrahedron)
    EXPECT_NEAR(Sum(CubicTetrahedronPlanes(n, CellRule::kCentre)) - 1, excess, 0.03 * excess) << n;
  EXPECT_NEAR(Sum(HemicubePlanes(100, CellRule::kCentre)) - 1, 5.42e-5, 0.01 * 5.42e-5);
  EXPECT_NEAR(Sum(CubicTetrahedronPlanes(142, CellRule::kCentre)) - 1, 7.99e-5, 0.01 * 7.99e-5);
}

// The largest and the smallest cells as printed.
TEST(PlaneGrid, PrintedExtremes) {
  double least = 1, largest = 0;
  const auto visit = [&](const std::vector<PlaneGrid>& planes) {
    least = 1, largest = 0;
    for (const PlaneGrid& plane : planes)
      for (const double delta : plane.delta) {
        if (delta > 0) least = std::min(least, delta);
        largest = std::max(largest, delta);
      }
  };
  visit(HemicubePlanes(100, CellRule::kCentre));
  EXPECT_NEAR(largest, 1.2727e-4, 1e-8);
  EXPECT_NEAR(least, 3.25e-7, 1e-9);
  visit(CubicTetrahedronPlanes(142, CellRule::kCentre));
  EXPECT_NEAR(largest, 9.845e-5, 1e-8);
  EXPECT_NEAR(least, 2.48e-8, 1e-10);
}

// A point below the centre of a square at several distances, by the closed form (Ashdown 1994, eq. 5.40).
TEST(ItemBuffer, PointBeforeASquare) {
  const std::map<double, double> truth = {
      {0.1, 0.968340}, {0.5, 0.554126}, {1, 0.2394564705}, {2, 0.0734776}, {5, 0.0125650}};
  for (const auto& [d, factor] : truth) {
    const Scene scene = FacingSquares(1, d);
    EXPECT_NEAR(FromCentre(scene, HemicubePlanes(200), 0.3), factor, 5e-3 * factor) << d;
    EXPECT_NEAR(FromCentre(scene, CubicTetrahedronPlanes(282), 0.3), factor, 5e-3 * factor) << d;
    EXPECT_NEAR(FromCentre(scene, TwoPlanes(224), 0.3), factor, 1.5e-2 * factor) << d;
  }
}

// The error over random turns falls at least with the 3/2-th power of the resolution: a cell's width times
// the square root of the number of cells along the boundary. At 50 and 100 cells it is what was computed
// independently of this program, 0.37 and 0.13 %, and at 200 cells no more than that, 0.043 %.
TEST(ItemBuffer, ConvergesAsEdgesOfRandomCells) {
  const Scene scene = FacingSquares(1, 1);
  constexpr double kTruth = 0.2394564705;
  const double coarse = RmsError(scene, HemicubePlanes(50), kTruth),
               middle = RmsError(scene, HemicubePlanes(100), kTruth),
               fine = RmsError(scene, HemicubePlanes(200), kTruth);
  std::printf("hemicube: %.3g %.3g %.3g\n", coarse, middle, fine);
  EXPECT_NEAR(coarse, 0.0037, 0.001);
  EXPECT_NEAR(middle, 0.0013, 0.0005);
  EXPECT_LT(fine, 0.0005);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.2);
  const double tetrahedron = RmsError(scene, CubicTetrahedronPlanes(142), kTruth),
               finer = RmsError(scene, CubicTetrahedronPlanes(284), kTruth);
  std::printf("cubic tetrahedron: %.3g %.3g\n", tetrahedron, finer);
  EXPECT_LT(tetrahedron, 2 * middle);
  EXPECT_LT(finer, tetrahedron / 2);
}

// What is narrower than a cell falls between the sample points of all cells, as Ashdown says of hemicube and
// cubic tetrahedron. The stated error says that it may.
TEST(ItemBuffer, MissesWhatIsSmallerThanACell) {
  const Scene scene = FacingSquares(1e-4, 1);
  for (const char* method : {"hemicube", "cubic-tetrahedron"}) {
    const FormFactorEstimate estimate = Between(scene, method, 0);
    EXPECT_EQ(estimate.factor, 0) << method;
    EXPECT_GT(estimate.error, 1e-9) << method;
  }
}

// A closed box of polygons that tile its walls: every cell sees exactly one of them, so that the factors to
// all tiles add up to 1, whatever the turn. A blocker in front takes what it hides.
TEST(ItemBuffer, TilesLeaveNoGapAndDoNotOverlap) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::AddBox(scene, {-0.6, -0.7, 0}, {0.5, 0.4, 0.9}, true, 0);
  const ElementForest forest = [&] {
    ElementForest tiles(scene);
    for (int level = 0; level < 3; ++level)
      for (const ElementId leaf : tiles.AllLeaves()) tiles.Subdivide(leaf);
    return tiles;
  }();
  PatchId floor = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    if (scene.patches[p].normal.z() > 0.5) floor = static_cast<PatchId>(p);
  for (const double angle : {0.0, 0.2, 0.785398163397448, 1.3})
    for (const auto& planes : {HemicubePlanes(31), CubicTetrahedronPlanes(40)}) {
      Eye eye;
      eye.own = floor;
      eye.x = {std::cos(angle), std::sin(angle), 0};
      eye.y = {-std::sin(angle), std::cos(angle), 0};
      std::vector<DrawnPolygon> tiles;
      for (const ElementId leaf : forest.AllLeaves())
        tiles.push_back(
            {forest[leaf].patch, forest[leaf].Vertices(), static_cast<std::int32_t>(tiles.size())});
      std::vector<double> factors(tiles.size(), 0);
      for (const PlaneGrid& plane : planes) ItemBuffer(plane, scene, eye, tiles).AddFactors(1, factors);
      double sum = 0;
      for (const double factor : factors) sum += factor;
      EXPECT_NEAR(sum, 1, 1e-12) << angle;
    }
}

// Form factors between areas: parallel and perpendicular squares, by their closed forms, within the stated
// error and some thousandths; and the same bytes on any number of threads.
TEST(ProjectedFormFactor, ParallelAndPerpendicularSquares) {
  constexpr double kParallel = 0.1998248957, kPerpendicular = 0.2000437761;
  const Scene parallel = FacingSquares(1, 1), edge = SquaresAtAnEdge();
  for (const auto& [method, bound] :
       std::map<std::string, double>{{"hemicube", 2e-3}, {"cubic-tetrahedron", 2e-3}, {"two-planes", 6e-3}}) {
    const FormFactorEstimate facing = Between(parallel, method, 400), corner = Between(edge, method, 400);
    std::printf("%s: %.6f +- %.2g, %.6f +- %.2g\n", method.c_str(), facing.factor, facing.error,
                corner.factor, corner.error);
    EXPECT_NEAR(facing.factor, kParallel, std::min(bound, facing.error)) << method;
    EXPECT_NEAR(corner.factor, kPerpendicular, std::min(3 * bound, 2 * corner.error)) << method;
    SetThreadCount(1);
    const double alone = Between(parallel, method, 100).factor;
    SetThreadCount(3);
    EXPECT_EQ(alone, Between(parallel, method, 100).factor);
    SetThreadCount(0);
  }
}

}  // namespace
}  // namespace penumbra
