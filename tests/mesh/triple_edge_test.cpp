#include "mesh/discontinuities/triple_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh_test_scenes.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::ThreeBoards;
using mesh_test::Tilt;

constexpr PatchId kReceiver = 0, kSource = 1;

// A turned light over a floor, and two triangles between them, no edge of anything in a plane with another's.
Scene TwoTriangles() {
  Scene scene = EmptyScene();
  AddSquare(scene, {0, 0, 0}, 8, true);
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

// The distance of a point of the receiver from the polyline of the pieces that `belongs` chooses.
template <class Belongs>
double FromPieces(const std::vector<Discontinuity>& found, const Vec2& x, const Belongs& belongs) {
  double least = std::numeric_limits<double>::infinity();
  for (const Discontinuity& d : found) {
    if (!belongs(d)) continue;
    const Vec2 along = d.end[1] - d.end[0], to = x - d.end[0];
    const double t = std::clamp(to.dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (to - t * along).norm());
  }
  return least;
}

// The hole between the three boards, whose inner edges start at their first vertices.
bool OfTheHole(const Discontinuity& d) {
  return d.source_part < 0 && d.blocker == 2 && d.second_blocker_edge.patch == 3 &&
         d.third_blocker_edge.patch == 4 && d.blocker_part == 0 && d.second_blocker_edge.k == 0 &&
         d.third_blocker_edge.k == 0;
}

// Where a hole between three boards closes before the inside of a large source: the point x belongs to the
// curve just if the planes through x and each of the edges have a line in common, whose determinant F is then
// zero. Along the polyline |F| over its gradient is the distance from the curve. The curve ends at the ends
// of the edges, or of the source's image.
TEST(TripleEdges, HolesCloseBeforeTheInsideOfASource) {
  for (const double degrees : {0.0, 25.0}) {
    Scene scene = ThreeBoards(3);
    if (degrees > 0) Tilt(scene, degrees);
    const Frame frame = PolygonFrame(scene.patches[kReceiver].Vertices());
    const auto determinant = [&](const Vec2& at) {
      const Vec3 x = frame.FromPlane(at);
      std::array<Vec3, 3> plane;
      for (int i = 0; i < 3; ++i) {
        const Edge edge = EdgeOf(scene, 2 + i, 0);
        plane[i] = (edge.a - x).cross(edge.b - x);
      }
      return plane[0].cross(plane[1]).dot(plane[2]);
    };
    for (const double tolerance : {1e-5, 1e-3, 1e-2}) {
      std::vector<Discontinuity> found = Find(scene, tolerance);
      std::erase_if(found, [](const Discontinuity& d) { return !OfTheHole(d); });
      ASSERT_FALSE(found.empty());
      double worst = 0, length = 0;
      for (const Discontinuity& d : found) {
        EXPECT_EQ(d.degree, DiscontinuityDegree::kD2);
        EXPECT_GT(d.geometric_weight, 0.3);
        EXPECT_LT(d.geometric_weight, 1);
        length += (d.end[1] - d.end[0]).norm();
        for (int i = 0; i <= 10; ++i) {
          const Vec2 x = d.end[0] + 0.1 * i * (d.end[1] - d.end[0]);
          constexpr double kStep = 1e-5;
          const Vec2 gradient =
              Vec2(determinant(x + kStep * Vec2::UnitX()) - determinant(x - kStep * Vec2::UnitX()),
                   determinant(x + kStep * Vec2::UnitY()) - determinant(x - kStep * Vec2::UnitY())) /
              (2 * kStep);
          const double off = std::abs(determinant(x)) / gradient.norm();
          worst = std::max(worst, off);
          EXPECT_LE(off, 1.01 * tolerance + 1e-12);
          if (i % 10 == 0) {
            EXPECT_LE(off, 1e-12) << "ends lie on the curve";
          }
        }
      }
      std::printf("tolerance %g: %zu pieces, %.3g m, at most %.2g m from the curve\n", tolerance,
                  found.size(), length, worst);
      EXPECT_GT(length, 0.5);
    }
  }
  // A light beside the lines, or so small that they miss it.
  const Scene small = ThreeBoards(0.05, 1.5), aside = ThreeBoards(0.5, 2.5);
  for (const Scene& scene : {small, aside}) {
    const std::vector<Discontinuity> found = Find(scene, 1e-3);
    EXPECT_TRUE(std::none_of(found.begin(), found.end(), OfTheHole));
  }
  // A lid on the hole closes it, and the hidden curve is there if asked for.
  Scene lid = ThreeBoards(3);
  AddSquare(lid, {0, 0, 2.6}, 1.5, true);
  std::vector<Discontinuity> found = Find(lid, 1e-3);
  EXPECT_TRUE(std::none_of(found.begin(), found.end(), OfTheHole));
  found = Find(lid, 1e-3, true);
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), OfTheHole));
}

// A floor, a light, and random triangles and a box between them.
Scene RandomTriangles(std::uint64_t seed) {
  Scene scene = EmptyScene();
  AddSquare(scene, {0, 0, 0}, 1.5, true);
  AddPatch(scene, {{0.9, 0.1, 4}, {0.1, -1, 4}, {-0.8, 0.05, 4}, {0, 1.1, 4}}, 1);
  Random random(seed);
  for (int i = 0; i < 4; ++i) {
    const Vec3 centre(random.Uniform(-0.4, 0.4), random.Uniform(-0.4, 0.4), random.Uniform(1, 3));
    const auto corner = [&] {
      return Vec3(centre +
                  Vec3(random.Uniform(-0.7, 0.7), random.Uniform(-0.7, 0.7), random.Uniform(-0.5, 0.5)));
    };
    const Vec3 a = corner(), b = corner(), c = corner();
    AddPatch(scene, {a, b, c});
  }
  AddBox(scene, {-0.2, -0.3, 0.5}, {0.3, 0.15, 0.9}, true);
  FindConvexSolids(scene);
  return scene;
}

PatchEdge ThirdEdge(const Discontinuity& d) {
  return d.source_part < 0 ? d.third_blocker_edge : PatchEdge{kSource, d.source_part};
}

// Lines through three edges of a scene, of the light and of what stands before it, taken one by one.
class TripleLines {
 public:
  // Three of the edges, by their place in the list.
  using Three = std::array<std::size_t, 3>;
  // The numbers of their silhouettes, ascending.
  using Event = std::array<std::int32_t, 3>;

  explicit TripleLines(const Scene& scene) : scene_(scene), silhouettes_(scene) {
    for (PatchId p = kSource; p < static_cast<PatchId>(scene.patches.size()); ++p)
      for (std::int32_t k = 0; k < scene.patches[p].size; ++k) {
        const std::int32_t number = silhouettes_.EdgeAt(p, k);
        if (std::find(number_.begin(), number_.end(), number) != number_.end()) continue;
        number_.push_back(number);
        edge_.push_back({p, k});
      }
  }

  std::size_t Count() const { return edge_.size(); }
  bool OfSource(std::size_t i) const { return edge_[i].patch == kSource; }
  // Whether two edges are of one body.
  bool OfOne(std::size_t i, std::size_t j) const { return Body(edge_[i]) == Body(edge_[j]); }
  Event EventOf(const Three& three) const {
    return Sorted({number_[three[0]], number_[three[1]], number_[three[2]]});
  }
  Event EventOf(const Discontinuity& d) const {
    const PatchEdge third = ThirdEdge(d);
    return Sorted({silhouettes_.EdgeAt(d.blocker, d.blocker_part),
                   silhouettes_.EdgeAt(d.second_blocker_edge.patch, d.second_blocker_edge.k),
                   silhouettes_.EdgeAt(third.patch, third.k)});
  }

  // Where the line from the point at t of the first edge, along the two others, meets the floor, if it starts
  // there and ends on the light, the edges are silhouettes, and nothing else blocks it.
  std::optional<Vec3> Foot(const Three& three, double t) const {
    const Edge one = EdgeAt(three[0]), two = EdgeAt(three[1]), last = EdgeAt(three[2]);
    const Vec3 p = one.a + t * (one.b - one.a);
    const Vec3 way = (two.a - p).cross(two.b - p).cross((last.a - p).cross(last.b - p)).normalized();
    const double second = ToEdge(p, way, two).at, third = ToEdge(p, way, last).at;
    if (std::min(second, third) < 0 || std::max(second, third) > 1) return std::nullopt;
    const Vec3 x = p - p.z() / way.z() * way, y = p + (4 - p.z()) / way.z() * way;
    if (x.head<2>().cwiseAbs().maxCoeff() > 1.5) return std::nullopt;
    const Patch& light = scene_.patches[kSource];
    if (!ConvexContains(light.Vertices(), light.normal, y, 1e-12)) return std::nullopt;
    for (const std::size_t e : three)
      if (!OfSource(e) && !silhouettes_.IsSilhouette(number_[e], x)) return std::nullopt;
    return Blocked(EventOf(three), x, y) ? std::nullopt : std::optional(x);
  }

 private:
  static int Body(const PatchEdge& e) { return std::min(e.patch, 6); }  // the box is one
  static Event Sorted(Event event) {
    std::sort(event.begin(), event.end());
    return event;
  }
  Edge EdgeAt(std::size_t i) const { return EdgeOf(scene_, edge_[i].patch, edge_[i].k); }

  // By what does not own an edge of the event.
  bool Blocked(const Event& event, const Vec3& x, const Vec3& y) const {
    bool blocked = false;
    for (PatchId q = 2; q < static_cast<PatchId>(scene_.patches.size()); ++q) {
      bool owner = false;
      for (const std::int32_t number : event)
        for (const PatchEdge& at : silhouettes_.Sharing(number)) owner |= at.patch == q;
      const Patch& patch = scene_.patches[q];
      const double hx = patch.normal.dot(x - patch.vertex[0]), hy = patch.normal.dot(y - patch.vertex[0]);
      blocked |= !owner && hx * hy < 0 &&
                 ConvexContains(patch.Vertices(), patch.normal, x + hx / (hx - hy) * (y - x), 0);
    }
    return blocked;
  }

  const Scene& scene_;
  Silhouettes silhouettes_;
  std::vector<PatchEdge> edge_;
  std::vector<std::int32_t> number_;  // of their silhouettes
};

// The lines at the ends of a piece touch its edges.
void ExpectEndsTouch(const Scene& scene, const Frame& frame, const Discontinuity& d) {
  for (const Vec2& end : d.end) {
    const Vec3 x = frame.FromPlane(end);
    const PatchEdge last = ThirdEdge(d);
    const Edge one = EdgeOf(scene, d.blocker, d.blocker_part),
               two = EdgeOf(scene, d.second_blocker_edge.patch, d.second_blocker_edge.k);
    const Vec3 way = (one.a - x).cross(one.b - x).cross((two.a - x).cross(two.b - x)).normalized();
    for (const Edge& edge : {one, two, EdgeOf(scene, last.patch, last.k)}) {
      const Nearness nearness = ToEdge(x, way, edge);
      EXPECT_LE(nearness.distance, 1e-9);
      EXPECT_GE(nearness.at, -1e-7);
      EXPECT_LE(nearness.at, 1 + 1e-7);
    }
  }
}

// No event is overlooked, however short: along one edge of each three, of the light and of random triangles
// and a box, lines through the two others are taken in small steps. Those that start on the floor and end on
// the light, as silhouettes, and are not blocked elsewhere, lie within the tolerance of a piece of the event;
// and the lines at the ends of pieces touch their edges.
TEST(TripleEdges, NoneIsOverlooked) {
  constexpr double kTolerance = 1e-3;
  constexpr int kSteps = 100;
  std::size_t points = 0, of_blockers = 0, pieces = 0;
  double worst = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Scene scene = RandomTriangles(seed);
    const Frame frame = PolygonFrame(scene.patches[kReceiver].Vertices());
    const std::vector<Discontinuity> found = Find(scene, kTolerance);
    pieces += found.size();
    const TripleLines lines(scene);
    const auto expect_found = [&](const TripleLines::Three& three) {
      if (lines.OfOne(three[0], three[1]) || lines.OfOne(three[1], three[2])) return;
      const TripleLines::Event event = lines.EventOf(three);
      for (int step = 0; step < kSteps; ++step) {
        const std::optional<Vec3> x = lines.Foot(three, (step + 0.5) / kSteps);
        if (!x) continue;
        ++points;
        if (!lines.OfSource(three[0])) ++of_blockers;
        const double off = FromPieces(found, frame.ToPlane(*x),
                                      [&](const Discontinuity& d) { return lines.EventOf(d) == event; });
        worst = std::max(worst, off);
        EXPECT_LE(off, kTolerance + 1e-12) << "seed " << seed << ": " << testing::PrintToString(three);
      }
    };
    for (std::size_t i = 0; i < lines.Count(); ++i)
      for (std::size_t j = i + 1; j < lines.Count(); ++j)
        for (std::size_t k = j + 1; k < lines.Count(); ++k) expect_found({i, j, k});
    for (const Discontinuity& d : found) ExpectEndsTouch(scene, frame, d);
  }
  std::printf("%zu pieces; %zu points, %zu of them of blockers' edges alone, at most %.2g m away\n", pieces,
              points, of_blockers, worst);
  EXPECT_GT(of_blockers, 100U);
}

// A curve that another blocker cuts off ends where its edge appears to touch: with a tolerance so wide that
// every arc is straight no two pieces of an event join, and past a board each end lies on the board's image
// or is an end of the whole curve.
TEST(TripleEdges, CurvesThatAreCutOffEndInOnePiece) {
  Scene scene = TwoTriangles();
  constexpr double kTolerance = 0.1;
  const auto own = [](std::vector<Discontinuity> found) {
    std::erase_if(found, [](const Discontinuity& d) {
      return d.source_part < 0 || d.blocker > 3 || d.second_blocker_edge.patch > 3;
    });
    return found;
  };
  const std::vector<Discontinuity> open = own(Find(scene, kTolerance));
  const PatchId board = AddPatch(scene, {{0.02, -2, 3.2}, {2, -2, 3.2}, {2, 2, 3.2}, {0.02, 2, 3.2}});
  const std::vector<Discontinuity> seen = own(Find(scene, kTolerance));
  const Frame frame = PolygonFrame(scene.patches[kReceiver].Vertices());
  int cut = 0;
  for (const Discontinuity& d : seen)
    for (const Vec2& end : d.end) {
      EXPECT_TRUE(std::none_of(seen.begin(), seen.end(), [&](const Discontinuity& other) {
        return &other != &d && other.source_part == d.source_part && other.blocker_part == d.blocker_part &&
               other.second_blocker_edge.k == d.second_blocker_edge.k &&
               (other.end[0] == end || other.end[1] == end);
      }));
      const bool whole = std::any_of(open.begin(), open.end(), [&](const Discontinuity& other) {
        return std::min((other.end[0] - end).norm(), (other.end[1] - end).norm()) < 1e-12;
      });
      if (whole) continue;
      ++cut;
      const Vec3 x = frame.FromPlane(end);
      const Edge first = EdgeOf(scene, d.blocker, d.blocker_part),
                 second = EdgeOf(scene, d.second_blocker_edge.patch, d.second_blocker_edge.k);
      const Vec3 direction =
          (first.a - x).cross(first.b - x).cross((second.a - x).cross(second.b - x)).normalized();
      EXPECT_LE(ToEdge(x, direction, EdgeOf(scene, board, 3)).distance, 1e-12);
    }
  std::printf("%zu arcs, %zu past a board, of which %d ends are cut\n", open.size(), seen.size(), cut);
  EXPECT_GT(cut, 0);
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
  AddSquare(box, {0, 0, 0}, 8, true);
  AddPatch(box, {{0.5, 0, 4}, {0.1, -0.4, 4}, {-0.45, 0.05, 4}, {0.05, 0.5, 4}}, 1);
  AddBox(box, {-0.3, -0.4, 1}, {0.4, 0.3, 1.8}, true);
  EXPECT_TRUE(Find(box, 1e-3).empty());

  Scene boards = EmptyScene();
  AddSquare(boards, {0, 0, 0}, 8, true);
  AddSquare(boards, {0, 0, 4}, 0.4, false, 1);
  AddSquare(boards, {0.1, 0.2, 1}, 0.5, true);
  AddSquare(boards, {-0.2, 0.1, 2}, 0.4, true);
  EXPECT_TRUE(Find(boards, 1e-3).empty());
}

}  // namespace
}  // namespace penumbra
