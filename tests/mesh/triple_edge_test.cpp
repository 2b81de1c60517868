#include "mesh/triple_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "mesh/discontinuity.h"
#include "mesh_test_scenes.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::Tilt;

constexpr PatchId kReceiver = 0, kSource = 1;

// A turned light over a floor, and two triangles between them, no edge of anything in a plane with another's.
Scene TwoTriangles() {
  Scene scene = EmptyScene();
  AddSquare(scene, 0, 0, 0, 8, true);
  AddPatch(scene, {{0.5, 0, 4}, {0.1, -0.4, 4}, {-0.45, 0.05, 4}, {0.05, 0.5, 4}}, 1);
  AddPatch(scene, {{-0.9, -0.9, 2.0}, {1.0, -0.7, 2.4}, {0.1, 0.35, 2.6}});
  AddPatch(scene, {{-0.8, 0.5, 1.2}, {0.1, -0.6, 1.0}, {0.9, 0.7, 1.5}});
  return scene;
}

std::vector<Discontinuity> Find(const Scene& scene, double tolerance, bool keep_hidden = false) {
  std::vector<double> strength(scene.patches.size(), 0.0);
  strength[kSource] = 1;
  DiscontinuityOptions options;
  options.triple_edge_tolerance = tolerance;
  options.keep_hidden = keep_hidden;
  const PatchVisibility visibility(scene);
  std::vector<Discontinuity> found =
      DiscontinuityFinder(scene, visibility).Find(kReceiver, strength, options);
  std::erase_if(found, [](const Discontinuity& d) { return d.kind != DiscontinuityKind::kEEE; });
  return found;
}

struct Edge {
  Vec3 a, b;
};
Edge EdgeOf(const Scene& scene, PatchId patch, std::int32_t k) {
  const Patch& p = scene.patches[patch];
  return {p.vertex[k], p.vertex[(k + 1) % p.size]};
}

// How far the line lies from the edge's line [m], and where on the edge it comes nearest, from 0 to 1.
struct Nearness {
  double distance, at;
};
Nearness ToEdge(const Vec3& x, const Vec3& direction, const Edge& edge) {
  const Vec3 along = edge.b - edge.a, across = direction.cross(along);
  const double at = (x - edge.a).cross(direction).dot(-across) / across.squaredNorm();
  return {std::abs(across.dot(x - edge.a)) / across.norm(), at};
}

// From every end of a piece there is a line that touches the light's edge and both blockers' edges: the line
// in which the planes through the point and the blockers' edges meet, to 1e-12, within all three edges.
TEST(TripleEdges, RuledLinesTouchAllThreeEdges) {
  for (const double degrees : {0.0, 25.0}) {
    Scene scene = TwoTriangles();
    if (degrees > 0) Tilt(scene, degrees);
    const Frame frame = PolygonFrame(scene.patches[kReceiver].Vertices());
    const std::vector<Discontinuity> found = Find(scene, 1e-3);
    double worst = 0;
    for (const Discontinuity& d : found) {
      EXPECT_EQ(d.degree, DiscontinuityDegree::kD2);
      EXPECT_EQ(d.source, kSource);
      EXPECT_NE(d.blocker, d.second_blocker_edge.patch);
      EXPECT_GT(d.geometric_weight, 0);
      EXPECT_LT(d.geometric_weight, 1);
      const Edge first = EdgeOf(scene, d.blocker, d.blocker_part);
      const Edge second = EdgeOf(scene, d.second_blocker_edge.patch, d.second_blocker_edge.k);
      for (const Vec2& end : d.end) {
        const Vec3 x = frame.FromPlane(end);
        const Vec3 direction =
            (first.a - x).cross(first.b - x).cross((second.a - x).cross(second.b - x)).normalized();
        for (const Edge& edge : {first, second, EdgeOf(scene, kSource, d.source_part)}) {
          const Nearness nearness = ToEdge(x, direction, edge);
          worst = std::max(worst, nearness.distance);
          EXPECT_LE(nearness.distance, 1e-12);
          EXPECT_GE(nearness.at, -1e-9);
          EXPECT_LE(nearness.at, 1 + 1e-9);
        }
      }
    }
    std::printf("%zu pieces, lines miss edges by %.2g m at most\n", found.size(), worst);
    EXPECT_GT(found.size(), 20U);
  }
}

// The curves in full: a point x of the floor belongs to one just if the light's edge passes, as seen from x,
// through where two edges appear to cross. Walked along the light's edges in small steps, for every pair of
// edges, every such point lies within the tolerance of a piece of that event.
TEST(TripleEdges, PolylinesLieWithinTheTolerance) {
  const Scene scene = TwoTriangles();
  const Frame frame = PolygonFrame(scene.patches[kReceiver].Vertices());
  std::size_t pieces = 10000;
  for (const double tolerance : {1e-5, 1e-4, 1e-3, 1e-2}) {
    const std::vector<Discontinuity> found = Find(scene, tolerance);
    EXPECT_LE(found.size(), pieces) << "a wider tolerance takes no more pieces";
    pieces = found.size();
    std::size_t points = 0;
    double worst = 0;
    for (std::int32_t k = 0; k < 4; ++k)
      for (std::int32_t i = 0; i < 3; ++i)
        for (std::int32_t j = 0; j < 3; ++j)
          for (int step = 0; step < 400; ++step) {
            const Edge light = EdgeOf(scene, kSource, k), first = EdgeOf(scene, 2, i),
                       second = EdgeOf(scene, 3, j);
            const Vec3 p = light.a + (step + 0.5) / 400 * (light.b - light.a);
            const Vec3 direction =
                (first.a - p).cross(first.b - p).cross((second.a - p).cross(second.b - p)).normalized();
            const Nearness one = ToEdge(p, direction, first), two = ToEdge(p, direction, second);
            if (std::min(one.at, two.at) < 0 || std::max(one.at, two.at) > 1) continue;
            const Vec3 q = first.a + one.at * (first.b - first.a),
                       r = second.a + two.at * (second.b - second.a);
            if (q.z() >= p.z() || r.z() >= p.z()) continue;
            const Vec3 x = p - p.z() / direction.z() * direction;
            ++points;
            double least = 1e9;
            for (const Discontinuity& d : found) {
              if (d.source_part != k || d.blocker_part != i || d.second_blocker_edge.k != j) continue;
              const Vec2 along = d.end[1] - d.end[0], to = frame.ToPlane(x) - d.end[0];
              const double t = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
              least = std::min(least, (to - t * along).norm());
            }
            worst = std::max(worst, least);
            EXPECT_LE(least, tolerance) << k << i << j;
          }
    std::printf("tolerance %g: %zu pieces, %zu points of the curves at most %.2g m away\n", tolerance,
                found.size(), points, worst);
    EXPECT_GT(points, 500U);
  }
}

// Off by default, nothing from one convex blocker, nothing where edges are parallel to axes in pairs; and
// what a third blocker hides is left out unless hidden parts are kept.
TEST(TripleEdges, OnlyWhereThereAreAny) {
  Scene scene = TwoTriangles();
  EXPECT_TRUE(Find(scene, 0).empty());
  const std::size_t open = Find(scene, 1e-3).size();
  // A board between the light and the triangles, over half of them.
  AddPatch(scene, {{0, -2, 3.2}, {2, -2, 3.2}, {2, 2, 3.2}, {0, 2, 3.2}});
  const std::size_t seen = Find(scene, 1e-3).size(), kept = Find(scene, 1e-3, true).size();
  std::printf("%zu pieces; under a board %zu, and %zu with those that it hides\n", open, seen, kept);
  EXPECT_GE(kept, open);
  EXPECT_LT(seen, kept);

  Scene box = EmptyScene();
  AddSquare(box, 0, 0, 0, 8, true);
  AddPatch(box, {{0.5, 0, 4}, {0.1, -0.4, 4}, {-0.45, 0.05, 4}, {0.05, 0.5, 4}}, 1);
  AddBox(box, {-0.3, -0.4, 1}, {0.4, 0.3, 1.8}, true);
  EXPECT_TRUE(Find(box, 1e-3).empty());

  Scene boards = EmptyScene();
  AddSquare(boards, 0, 0, 0, 8, true);
  AddSquare(boards, 0, 0, 4, 0.4, false, 1);
  AddSquare(boards, 0.1, 0.2, 1, 0.5, true);
  AddSquare(boards, -0.2, 0.1, 2, 0.4, true);
  EXPECT_TRUE(Find(boards, 1e-3).empty());
}

}  // namespace
}  // namespace penumbra
