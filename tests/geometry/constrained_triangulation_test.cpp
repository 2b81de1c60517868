#include "solver/geometry/constrained_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "solver/base/random.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

using Triangle = ConstrainedTriangulation::Triangle;

double TriangleArea(const ConstrainedTriangulation& mesh, const Triangle& t) {
  return SignedArea(
      std::array{mesh.vertices[t.vertex[0]], mesh.vertices[t.vertex[1]], mesh.vertices[t.vertex[2]]});
}

double InsideArea(const ConstrainedTriangulation& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles)
    if (t.Inside()) sum += TriangleArea(mesh, t);
  return sum;
}

std::vector<ConstraintSegment> Loop(std::int32_t count, std::int32_t first = 0) {
  std::vector<ConstraintSegment> loop;
  for (std::int32_t i = 0; i < count; ++i) loop.push_back({first + i, first + (i + 1) % count, kBorder});
  return loop;
}

// What holds for every result, whatever the input.
void CheckMesh(const ConstrainedTriangulation& mesh, std::span<const Vec2> points,
               std::span<const ConstraintSegment> constraints, double extent) {
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_EQ(mesh.vertices[i], points[i]) << "input points never move";
  std::map<std::pair<int, int>, int> sides;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& triangle = mesh.triangles[t];
    ASSERT_EQ(Orientation(mesh.vertices[triangle.vertex[0]], mesh.vertices[triangle.vertex[1]],
                          mesh.vertices[triangle.vertex[2]]),
              1);
    for (int k = 0; k < 3; ++k) {
      const int a = triangle.vertex[k], b = triangle.vertex[(k + 1) % 3];
      ASSERT_EQ(++sides[std::pair(a, b)], 1) << "each side belongs to one triangle";
      if (triangle.neighbor[k] < 0) continue;
      const Triangle& other = mesh.triangles[triangle.neighbor[k]];
      bool back = false;
      for (int l = 0; l < 3; ++l)
        if (other.vertex[l] == b && other.vertex[(l + 1) % 3] == a) {
          back = other.neighbor[l] == static_cast<int>(t) && other.tag[l] == triangle.tag[k] &&
                 other.border[l] == triangle.border[k];
          if (!triangle.border[k]) {
            EXPECT_EQ(other.winding, triangle.winding);
          }
        }
      ASSERT_TRUE(back);
    }
  }
  // Every constraint is a chain of edges of the mesh, as long as itself, that leaves it by rounding only.
  std::vector<double> covered(constraints.size(), 0);
  for (const auto& edge : mesh.edges) {
    EXPECT_TRUE(sides.contains({edge.a, edge.b}) || sides.contains({edge.b, edge.a}));
    const Vec2 along = mesh.vertices[edge.b] - mesh.vertices[edge.a];
    for (const auto& cover : mesh.Covers(edge)) {
      const Vec2 a = points[constraints[cover.constraint].from], b = points[constraints[cover.constraint].to];
      const Vec2 unit = (b - a).normalized();
      covered[cover.constraint] += (cover.forward ? 1 : -1) * unit.dot(along);
      EXPECT_LE(std::abs(Cross2(unit, mesh.vertices[edge.a] - a)), 4 * kSnapDistance * extent);
    }
  }
  for (std::size_t i = 0; i < constraints.size(); ++i)
    EXPECT_NEAR(covered[i], (points[constraints[i].to] - points[constraints[i].from]).norm(), 1e-12 * extent);
}

TEST(ConstrainedTriangulation, UnitSquareAndItsDiagonals) {
  // Two crossing diagonals of a square meet in one new vertex, and each of the four triangles bears one tag a
  // side.
  const std::vector<Vec2> points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<ConstraintSegment> constraints = Loop(4);
  constraints.push_back({0, 2, 5});
  constraints.push_back({1, 3, 3});
  ConstrainedTriangulator triangulator;
  const ConstrainedTriangulation& mesh = triangulator.Triangulate(points, constraints);
  CheckMesh(mesh, points, constraints, 1);
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[4], Vec2(0.5, 0.5));
  ASSERT_EQ(mesh.triangles.size(), 4u);
  std::multiset<int> tags;
  for (const Triangle& t : mesh.triangles) {
    EXPECT_EQ(t.winding, 1);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(t.border[k], t.tag[k] == kNoTag);
      tags.insert(t.tag[k]);
    }
  }
  EXPECT_EQ(tags, (std::multiset<int>{kNoTag, kNoTag, kNoTag, kNoTag, 3, 3, 3, 3, 5, 5, 5, 5}));
}

TEST(ConstrainedTriangulation, OverlappingTagsReportTheSmallestAndTheBorder) {
  // Where a border and two tagged segments share an edge, the smallest tag is reported beside the border
  // flag.
  const std::vector<Vec2> points = {{0, 0}, {4, 0}, {4, 1}, {0, 1}, {1, 0}, {3, 0}, {2, 0}};
  std::vector<ConstraintSegment> constraints = Loop(4);
  constraints.push_back({4, 5, 7});
  constraints.push_back({1, 6, 2});
  ConstrainedTriangulator triangulator;
  const ConstrainedTriangulation& mesh = triangulator.Triangulate(points, constraints);
  CheckMesh(mesh, points, constraints, 4);
  std::map<double, int> tag_at;
  for (const Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec2 a = mesh.vertices[t.vertex[k]], b = mesh.vertices[t.vertex[(k + 1) % 3]];
      if (a.y() != 0 || b.y() != 0) continue;
      EXPECT_TRUE(t.border[k]);
      tag_at[a.x()] = t.tag[k];
    }
  EXPECT_EQ(tag_at, (std::map<double, int>{{0, kNoTag}, {1, 7}, {2, 2}, {3, 2}}));
}

TEST(ConstrainedTriangulation, WindingTellsHolesAndSlits) {
  // A hole's border runs clockwise: what it surrounds is outside; a bridge walked twice changes nothing.
  const std::vector<Vec2> points = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {1, 3}, {3, 3}, {3, 1}};
  std::vector<ConstraintSegment> constraints;
  const std::vector<int> keyhole = {0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  for (std::size_t i = 0; i < keyhole.size(); ++i)
    constraints.push_back({keyhole[i], keyhole[(i + 1) % keyhole.size()], kBorder});
  ConstrainedTriangulator triangulator;
  const ConstrainedTriangulation& mesh = triangulator.Triangulate(points, constraints);
  CheckMesh(mesh, points, constraints, 4);
  EXPECT_EQ(InsideArea(mesh), 12);
}

TEST(ConstrainedTriangulation, DegenerateInputs) {
  // No points, one, many in one place or on one line have no triangles; repeated points count once.
  ConstrainedTriangulator triangulator;
  EXPECT_TRUE(triangulator.Triangulate({}, {}).triangles.empty());
  const std::vector<Vec2> same(5, Vec2(1, 2));
  EXPECT_TRUE(triangulator.Triangulate(same, std::vector<ConstraintSegment>{{0, 4, 1}}).triangles.empty());
  const std::vector<Vec2> line = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  EXPECT_TRUE(triangulator.Triangulate(line, std::vector<ConstraintSegment>{{0, 3, 1}}).triangles.empty());
  const std::vector<Vec2> twice = {{0, 0}, {0, 0}, {1, 0}, {1, 0}, {0, 1}, {0, 1}};
  const auto& mesh = triangulator.Triangulate(
      twice, std::vector<ConstraintSegment>{{1, 3, kBorder}, {2, 5, kBorder}, {4, 0, kBorder}});
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0].vertex, (std::array<std::int32_t, 3>{0, 2, 4}));
  EXPECT_TRUE(mesh.triangles[0].Inside());
}

TEST(ConstrainedTriangulation, RandomCrossingSegmentsInASquare) {
  // Whatever crosses within a border, the triangles inside add up to its area; also where everything lies on
  // a grid.
  Random random(7);
  ConstrainedTriangulator triangulator;
  double worst = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const double size = random.LogUniform(1e-6, 1e6), shift = trial % 5 == 0 ? 100 * size : 0;
    const auto coordinate = [&] {
      const double x = random.Uniform();
      return shift + size * (trial % 3 == 0 ? std::floor(5 * x) / 4 : x);
    };
    std::vector<Vec2> points = {
        {shift, shift}, {shift + size, shift}, {shift + size, shift + size}, {shift, shift + size}};
    std::vector<ConstraintSegment> constraints = Loop(4);
    const int count = 1 + static_cast<int>(random.Index(25));
    for (int i = 0; i < count; ++i) {
      const auto n = static_cast<std::int32_t>(points.size());
      points.push_back({coordinate(), coordinate()});
      points.push_back({coordinate(), coordinate()});
      // Some lines run through the middle, to within rounding.
      if (i % 4 == 3) points.back() = Vec2::Constant(2 * shift + size) - points[n];
      if (points[n] != points[n + 1]) constraints.push_back({n, n + 1, i});
    }
    const ConstrainedTriangulation& mesh = triangulator.Triangulate(points, constraints);
    CheckMesh(mesh, points, constraints, size + shift);
    if (HasFailure()) FAIL() << "trial " << trial;
    if (shift == 0) worst = std::max(worst, std::abs(InsideArea(mesh) / (size * size) - 1));
  }
  std::printf("largest relative error of the area: %.3g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

TEST(ConstrainedTriangulation, PointsCrowdedWithinTheSnapDistance) {
  // Clusters of points about as far apart as the snap distance, or the rounding, with segments between and
  // within them.
  Random random(17);
  ConstrainedTriangulator triangulator;
  for (int trial = 0; trial < 2000; ++trial) {
    const double noise = kSnapDistance * random.LogUniform(1e-3, 1e2);
    std::vector<Vec2> points;
    const int n = 4 + static_cast<int>(random.Index(20));
    for (int i = 0; i < n; ++i)
      points.push_back(
          {random.Index(3) + noise * random.Uniform(), random.Index(3) + noise * random.Uniform()});
    std::vector<ConstraintSegment> constraints;
    for (int i = 0; i < n; ++i) {
      const auto from = static_cast<std::int32_t>(random.Index(n)),
                 to = static_cast<std::int32_t>(random.Index(n));
      if (points[from] != points[to]) constraints.push_back({from, to, i});
    }
    const ConstrainedTriangulation& mesh = triangulator.Triangulate(points, constraints);
    std::set<std::pair<int, int>> sides;
    for (const Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) sides.emplace(std::minmax({t.vertex[k], t.vertex[(k + 1) % 3]}));
    for (const auto& edge : mesh.edges) ASSERT_TRUE(sides.contains({edge.a, edge.b})) << "trial " << trial;
  }
}

TEST(ConstrainedTriangulation, ReuseChangesNothing) {
  // A triangulator that has done other work gives the result that a new one gives.
  Random random(11);
  ConstrainedTriangulator used;
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<Vec2> points;
    std::vector<ConstraintSegment> constraints;
    for (int i = 0; i < 30; ++i) points.push_back({random.Uniform(), random.Uniform()});
    for (int i = 0; i + 1 < 30; i += 2) constraints.push_back({i, i + 1, i});
    ConstrainedTriangulator fresh;
    const auto& a = used.Triangulate(points, constraints);
    const auto& b = fresh.Triangulate(points, constraints);
    EXPECT_EQ(a.vertices, b.vertices);
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t t = 0; t < a.triangles.size(); ++t) {
      EXPECT_EQ(a.triangles[t].vertex, b.triangles[t].vertex);
      EXPECT_EQ(a.triangles[t].tag, b.triangles[t].tag);
    }
  }
}

TEST(Orientation, IsExactNextToALine) {
  // One unit in the last place to either side of a line decides, and the sign turns with the order of the
  // points.
  const Vec2 a(0.1, 0.1), b(12, 12);
  for (const double x : {0.5, 3.3, 24.7}) {
    EXPECT_EQ(Orientation(a, b, {x, x}), 0);
    EXPECT_EQ(Orientation(a, b, {x, std::nextafter(x, 100)}), 1);
    EXPECT_EQ(Orientation(a, b, {x, std::nextafter(x, -100)}), -1);
    EXPECT_EQ(Orientation(b, a, {x, std::nextafter(x, 100)}), -1);
  }
  const double tiny = 1e-200;  // products underflow
  EXPECT_EQ(Orientation({0, 0}, {tiny, 0}, {0, tiny}), 1);
}

}  // namespace
}  // namespace penumbra
