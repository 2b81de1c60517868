// Means of interpolants over polygons that cross the mesh, and midpoints predicted from vertices.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <vector>

#include "mesh/interpolants/corner_sheets.h"
#include "mesh/interpolants/midpoint_prediction.h"
#include "mesh/refinement/covered_light.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

// The unit square as n x n squares of two triangles each, with the interpolants of a function.
IrradianceMesh Grid(int n, const std::function<Rgb(double, double)>& light) {
  IrradianceMesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.emplace_back(double(i) / n, double(j) / n, 0);
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({{a, b, c}, 0, {false, false, false}});
    std::array<Rgb, 6> sample;
    for (std::size_t s = 0; s < 6; ++s) {
      const Vec3 p = mesh.positions[a] + kSampleAt[s][0] * (mesh.positions[b] - mesh.positions[a]) +
                     kSampleAt[s][1] * (mesh.positions[c] - mesh.positions[a]);
      sample[s] = light(p.x(), p.y());
    }
    mesh.irradiance.push_back(QuadraticInterpolant::Quadratic(sample));
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      add(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      add(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  return mesh;
}

Rgb Quadratic(double x, double y) {
  return {2 + x - y + x * y, 1 + 3 * x * x + y, 4 - 2 * y * y + x * y - x};
}

// A convex polygon inside the unit square.
Polygon2 RandomConvex(Random& random) {
  const int n = 3 + static_cast<int>(random.Index(5));
  const Vec2 centre(random.Uniform(0.3, 0.7), random.Uniform(0.3, 0.7));
  const double radius = random.Uniform(0.01, 0.29), turn = random.Uniform(0, 6);
  Polygon2 polygon;
  for (int k = 0; k < n; ++k) {
    const double angle = turn + 2 * M_PI * k / n;
    polygon.emplace_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

// The mean of a quadratic over a polygon: the midpoint rule on a fan is exact.
Rgb ExactMean(const Polygon2& p) {
  Rgb sum = Rgb::Zero();
  double area = 0;
  for (std::size_t i = 2; i < p.size(); ++i) {
    const double a = 0.5 * Cross2(p[i - 1] - p[0], p[i] - p[0]);
    const Vec2 m[3] = {0.5 * (p[0] + p[i - 1]), 0.5 * (p[i - 1] + p[i]), 0.5 * (p[i] + p[0])};
    for (const Vec2& q : m) sum += a / 3 * Quadratic(q.x(), q.y());
    area += a;
  }
  return sum / area;
}

TEST(CoveredLight, HasTheExactMean) {
  const IrradianceMesh mesh = Grid(7, Quadratic);
  const CoveredLight whole(mesh, 0, static_cast<std::uint32_t>(mesh.triangles.size()), Frame());
  EXPECT_NEAR(whole.area(), 1, 1e-12);
  // Pieces of a millionth of a triangle, with corners 1e-3 of its size apart, may be omitted.
  constexpr double kOmitted = 1e-3;
  Random random(31);
  double worst = 0, worst_area = 0;
  for (int i = 0; i < 2000; ++i) {
    const Polygon2 polygon = RandomConvex(random);
    const CoveredLight part = whole.Within(polygon);
    worst_area = std::max(worst_area, std::abs(part.area() / SignedArea(polygon) - 1));
    worst = std::max(worst, (part.Mean() - ExactMean(polygon)).abs().maxCoeff());
    const Rgb deviation = part.Deviation(part.Mean());
    for (const Vec2& p : polygon)
      EXPECT_TRUE(((Quadratic(p.x(), p.y()) - part.Mean()).abs() <= deviation + kOmitted).all());
  }
  std::printf("seed 31, largest difference of means %.2g, of areas %.2g\n", worst, worst_area);
  EXPECT_LE(worst, kOmitted);
  EXPECT_LE(worst_area, kOmitted);
}

std::vector<std::array<Rgb, 3>> Corners(const IrradianceMesh& mesh) {
  std::vector<std::array<Rgb, 3>> corner;
  for (const QuadraticInterpolant& q : mesh.irradiance)
    corner.push_back({q.At(0, 0), q.At(1, 0), q.At(0, 1)});
  return corner;
}

// Where the triangles around both ends are symmetric, the prediction is exact for quadratics; elsewhere it
// errs by part of the bend.
TEST(MidpointPrediction, IsExactForQuadraticsInsideAGrid) {
  const IrradianceMesh mesh = Grid(8, Quadratic);
  const std::vector<std::array<Rgb, 3>> corner = Corners(mesh);
  const CornerSheets sheets(mesh);
  const MidpointPrediction prediction(mesh, sheets, corner);
  double worst = 0, worst_at_border = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = mesh.positions[mesh.triangles[t].vertex[k]],
                 &b = mesh.positions[mesh.triangles[t].vertex[(k + 1) % 3]], m = 0.5 * (a + b);
      const double error = (prediction.At(t, k).value - Quadratic(m.x(), m.y())).abs().maxCoeff();
      const auto inside = [](const Vec3& p) { return p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1; };
      double& largest = inside(a) && inside(b) ? worst : worst_at_border;
      largest = std::max(largest, error);
    }
  // The bends of the quadratic: second derivative 6, side 1/8.
  constexpr double kBend = 6.0 / 8 / 8 / 8;
  std::printf("largest error inside %.2g, at the border %.2g of bends of %.2g\n", worst, worst_at_border,
              kBend);
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(worst_at_border, 2 * kBend);
}

// The gradients on one side of a discontinuity know nothing of the other side.
TEST(MidpointPrediction, StopsAtDiscontinuities) {
  const auto step = [](double x, double) { return Rgb(Rgb::Constant(x)); };
  IrradianceMesh mesh = Grid(4, step);
  std::vector<std::array<Rgb, 3>> corner = Corners(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double middle = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& v = mesh.triangles[t].vertex;
      const Vec3 &a = mesh.positions[v[k]], &b = mesh.positions[v[(k + 1) % 3]];
      mesh.triangles[t].discontinuity[k] = a.x() == 0.5 && b.x() == 0.5;
      middle += a.x() / 3;
    }
    if (middle > 0.5)
      for (Rgb& value : corner[t]) value += 100;
  }
  const CornerSheets sheets(mesh);
  const MidpointPrediction prediction(mesh, sheets, corner);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_LE(prediction.At(t, k).bend.abs().maxCoeff(), 1e-12);
}

// The sheet at the middle of a straight border is the same for any triangles.
TEST(CornerSheets, AreStraightAlongBorders) {
  for (const int n : {2, 4, 6}) {
    IrradianceMesh mesh = Grid(n, Quadratic);
    const CornerSheets sheets(mesh);
    int straight = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t sheet = sheets.Of(CornerSheets::Corner(t, k));
        const Vec3& p = mesh.positions[mesh.triangles[t].vertex[k]];
        const bool on_x = p.x() == 0 || p.x() == 1, on_y = p.y() == 0 || p.y() == 1;
        EXPECT_EQ(sheets.IsStraight(sheet), on_x != on_y);
        if (!sheets.IsStraight(sheet)) continue;
        ++straight;
        const Vec3 want = on_x ? Vec3(1 - 2 * p.x(), 0, 0) : Vec3(0, 1 - 2 * p.y(), 0);
        EXPECT_EQ(sheets.Into(sheet), want);
      }
    EXPECT_EQ(straight, 4 * (n - 1) * 3);
  }
}

// A discontinuity along the middle of the square divides the sheets on it into two straight ones.
TEST(CornerSheets, AreDividedByDiscontinuities) {
  IrradianceMesh mesh = Grid(4, Quadratic);
  for (IrradianceMesh::Triangle& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      t.discontinuity[k] =
          mesh.positions[t.vertex[k]].x() == 0.5 && mesh.positions[t.vertex[(k + 1) % 3]].x() == 0.5;
  const CornerSheets sheets(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double middle = 0;
    for (std::size_t k = 0; k < 3; ++k) middle += mesh.positions[mesh.triangles[t].vertex[k]].x() / 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& p = mesh.positions[mesh.triangles[t].vertex[k]];
      if (p.x() != 0.5 || p.y() == 0 || p.y() == 1) continue;
      EXPECT_EQ(sheets.Into(sheets.Of(CornerSheets::Corner(t, k))), Vec3(middle > 0.5 ? 1 : -1, 0, 0));
    }
  }
}

// A border vertex that rounding has put beside a corner of the patch: the sheets at both are not straight,
// because neither shows where the lines lead that end in the other. Elsewhere sheets stay straight.
TEST(CornerSheets, AreNotStraightAtFlatTriangles) {
  constexpr double kOff = 1e-7;
  IrradianceMesh mesh;
  mesh.positions = {{0, 0, 0}, {kOff, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (const std::array<std::uint32_t, 3>& vertex :
       {std::array<std::uint32_t, 3>{0, 1, 5}, {1, 2, 5}, {2, 4, 5}, {2, 3, 4}})
    mesh.triangles.push_back({.vertex = vertex, .patch = 0});
  const std::array<double, 1> wide = {10 * kOff}, narrow = {0.1 * kOff};
  const FlatTriangles flat(mesh, wide), none(mesh, narrow);
  EXPECT_TRUE(flat.Contains(0));
  EXPECT_EQ(flat.Beside(0), 1U);
  EXPECT_FALSE(flat.Contains(1));
  EXPECT_FALSE(none.Contains(0));
  const CornerSheets sheets(mesh, &flat), exact(mesh, &none);
  const auto corner = [](std::size_t t, std::size_t k) { return CornerSheets::Corner(t, k); };
  EXPECT_FALSE(sheets.IsStraight(sheets.Of(corner(1, 0))));
  EXPECT_TRUE(exact.IsStraight(exact.Of(corner(1, 0))));
  EXPECT_TRUE(sheets.IsStraight(sheets.Of(corner(1, 1))));
}

}  // namespace
}  // namespace penumbra
