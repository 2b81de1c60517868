#include "mesh/discontinuities/discontinuity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh_test_scenes.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::Tilt;

std::vector<double> Strengths(const Scene& scene, PatchId light, double strength) {
  std::vector<double> result(scene.patches.size(), 0.0);
  result[static_cast<std::size_t>(light)] = strength;
  return result;
}

// Of the thesis's weight.
DiscontinuityOptions AtLeast(double min_weight) {
  DiscontinuityOptions options;
  options.min_weight = min_weight;
  return options;
}

bool SameSegment(const Discontinuity& d, const Vec2& a, const Vec2& b, double tolerance) {
  const auto near = [&](const Vec2& p, const Vec2& q) { return (p - q).norm() <= tolerance; };
  return (near(d.end[0], a) && near(d.end[1], b)) || (near(d.end[0], b) && near(d.end[1], a));
}

// Beside the edges of a light that hangs closely above a floor lines run along them, as far away as the
// height times ever larger factors; what weighs them falls with the distance. None beside a light that hangs
// higher.
TEST(DiscontinuityFinder, LinesAlongEdgesThatHangClosely) {
  constexpr double kHalf = 0.5, kClose = 0.001;
  for (const double height : {kClose, 0.1}) {
    Scene scene = EmptyScene();
    const PatchId floor = AddSquare(scene, {0, 0, 0}, 2, true);
    const PatchId light = AddSquare(scene, {0, 0, height}, kHalf, false, 1);
    const PatchVisibility visibility(scene);
    const DiscontinuityFinder finder(scene, visibility);
    DiscontinuityOptions options = AtLeast(0);
    options.weight = DiscontinuityWeight::kIrradiance;
    std::set<long> offsets;  // from the edges, in thousandths of the height
    double nearest = 0, farthest = 0;
    for (const Discontinuity& d : finder.Find(floor, Strengths(scene, light, 10), options)) {
      ASSERT_EQ(d.kind, DiscontinuityKind::kNear);
      EXPECT_EQ(d.source, light);
      EXPECT_EQ(d.blocker, kNoPatch);
      const Vec2 middle = 0.5 * (d.end[0] + d.end[1]) - Vec2(2, 2);  // in the frame of the floor's corner
      const double offset = (middle.cwiseAbs().maxCoeff() - kHalf) / height;
      offsets.insert(std::lround(1000 * offset));
      if (std::abs(offset) < 0.1) nearest = d.weight;
      if (offset > 14) farthest = d.weight;
    }
    EXPECT_EQ(offsets.size(), height == kClose ? 15U : 0U);
    if (height != kClose) continue;
    EXPECT_GT(nearest, 100 * farthest);
    EXPECT_GT(farthest, 0);
    EXPECT_LE(nearest, 10);
  }
}

// A square light (half side l, height H) over a plane with a floating square blocker (half side b, height h):
// seen through each corner of the light the blocker's shadow is a square of half side b H / (H - h), moved
// against the corner by l h / (H - h). The boundaries of umbra and penumbra are among their sides, by similar
// triangles.
TEST(DiscontinuityFinder, SquareLightAndBlockerCastSquares) {
  constexpr double kL = 0.3, kB = 0.5, kTall = 3, kLow = 1.25;
  for (const double degrees : {0.0, 20.0}) {
    Scene scene = EmptyScene();
    const PatchId floor = AddSquare(scene, {0, 0, 0}, 4, true);
    const PatchId light = AddSquare(scene, {0, 0, kTall}, kL, false, 1);
    AddSquare(scene, {0, 0, kLow}, kB, true);
    Tilt(scene, degrees);
    const PatchVisibility visibility(scene);
    const DiscontinuityFinder finder(scene, visibility);
    const std::vector<Discontinuity> found = finder.Find(floor, Strengths(scene, light, 10), AtLeast(0));
    const double half = kB * kTall / (kTall - kLow), shift = kL * kLow / (kTall - kLow);
    int ve = 0, ev = 0;
    for (const Discontinuity& d : found) {
      EXPECT_EQ(d.source, light);
      EXPECT_NEAR(d.geometric_weight, (kTall - kLow) / kTall, 1e-14);
      EXPECT_NEAR(d.weight, 10 * (kTall - kLow) / kTall, 1e-13);
      // Edges of the light and of the blocker are parallel in pairs: their events are degenerate, and share
      // lines.
      if (d.kind == DiscontinuityKind::kVE) ++ve;
      if (d.kind == DiscontinuityKind::kEV) ++ev;
    }
    EXPECT_EQ(ve, 16);
    EXPECT_EQ(ev, 16);
    EXPECT_EQ(found.size(), 32U);
    for (const double sx : {-1.0, 1.0})
      for (const double sy : {-1.0, 1.0}) {
        // The frame's origin is the floor's corner (-4, -4), its axes are those of the world before the tilt.
        const Vec2 centre = Vec2(4, 4) + shift * Vec2(sx, sy);
        const std::array<Vec2, 4> corner = {centre + Vec2(-half, -half), centre + Vec2(half, -half),
                                            centre + Vec2(half, half), centre + Vec2(-half, half)};
        for (int k = 0; k < 4; ++k)
          EXPECT_EQ(std::count_if(found.begin(), found.end(),
                                  [&](const Discontinuity& d) {
                                    return d.kind == DiscontinuityKind::kVE &&
                                           SameSegment(d, corner[k], corner[(k + 1) % 4], 1e-12);
                                  }),
                    1)
              << degrees << " degrees, corner " << sx << ", " << sy << ", side " << k;
      }
  }
}

// The weight is the source's strength times at most 1: a source that cannot reach the minimum gives nothing,
// and every discontinuity reaches it.
TEST(DiscontinuityFinder, WeakSourcesAreLeftOut) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 4, true);
  const PatchId light = AddSquare(scene, {0.1, 0.2, 3}, 0.3, false, 1);
  AddSquare(scene, {0, 0, 2.5}, 0.2, true);
  AddSquare(scene, {0, 0, 0.5}, 0.3, true);
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  EXPECT_TRUE(finder.Find(floor, Strengths(scene, light, 10), AtLeast(10.5)).empty());
  const auto all = finder.Find(floor, Strengths(scene, light, 10), AtLeast(0));
  DiscontinuityOptions whole = AtLeast(5);
  whole.keep_hidden = true;
  const auto strong = finder.Find(floor, Strengths(scene, light, 10), whole);
  EXPECT_LT(strong.size(), all.size());
  EXPECT_EQ(strong.size(), 32U);
  for (const Discontinuity& d : strong) EXPECT_NEAR(d.weight, 10 * 2.5 / 3, 1e-13);
}

// A box on a floor touches it along the four sides of its foot, with or without a bottom face, turned any
// way: D0 of infinite weight.
TEST(DiscontinuityFinder, BoxTouchesFloorAlongItsFoot) {
  for (const double degrees : {0.0, 20.0, 33.0})
    for (const bool bottom : {false, true}) {
      Scene scene = EmptyScene();
      const PatchId floor = AddSquare(scene, {0, 0, 0}, 2, true);
      AddBox(scene, {-0.5, -0.3, 0}, {0.7, 0.4, 1}, bottom);
      Tilt(scene, degrees);
      const PatchVisibility visibility(scene);
      const DiscontinuityFinder finder(scene, visibility);
      const auto found = finder.Find(floor, std::vector<double>(scene.patches.size(), 0.0), AtLeast(0));
      EXPECT_EQ(found.size(), bottom ? 8U : 4U);
      const std::array<Vec2, 4> foot = {Vec2(1.5, 1.7), Vec2(2.7, 1.7), Vec2(2.7, 2.4), Vec2(1.5, 2.4)};
      for (int k = 0; k < 4; ++k)
        EXPECT_EQ(std::count_if(found.begin(), found.end(),
                                [&](const Discontinuity& d) {
                                  return d.degree == DiscontinuityDegree::kD0 &&
                                         d.weight == kInfiniteWeight &&
                                         SameSegment(d, foot[k], foot[(k + 1) % 4], 1e-12);
                                }),
                  bottom ? 2 : 1)
            << degrees << (bottom ? " with bottom" : "");
    }
}

// Walls that stand on the floor's outline, a ceiling, and a box hanging under the floor touch it nowhere that
// matters; a board through the floor touches it along the cut.
TEST(DiscontinuityFinder, OnlyContactsOnTheFrontCount) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 2, true);
  AddPatch(scene, {{-2, -2, 0}, {-2, 2, 0}, {-2, 2, 2}, {-2, -2, 2}});
  AddSquare(scene, {0, 0, 2}, 2, false);
  AddBox(scene, {-0.5, -0.3, -1}, {0.7, 0.4, 0}, true);
  const PatchVisibility visibility(scene);
  // Its lid looks the same way as the floor and lies in its plane.
  EXPECT_TRUE(DiscontinuityFinder(scene, visibility)
                  .Find(floor, std::vector<double>(scene.patches.size(), 0.0), AtLeast(0))
                  .empty());
  AddPatch(scene, {{0, -1, -0.5}, {0, 1, -0.5}, {0, 1, 0.5}, {0, -1, 0.5}});
  const PatchVisibility after(scene);
  const auto found = DiscontinuityFinder(scene, after)
                         .Find(floor, std::vector<double>(scene.patches.size(), 0.0), AtLeast(0));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(SameSegment(found[0], {2, 1}, {2, 3}, 1e-12));
}

// A light whose plane cuts the floor lights it up to that line only: a D1 horizon of geometric weight 1.
TEST(DiscontinuityFinder, SourcePlaneCutsReceiver) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 2, true);
  // Leaning: its plane is x = 0.5 - 0.25 z.
  const PatchId light = AddPatch(scene, {{0.25, -0.2, 1}, {0.25, 0.2, 1}, {0, 0.2, 2}, {0, -0.2, 2}}, 1);
  const PatchVisibility visibility(scene);
  const auto found =
      DiscontinuityFinder(scene, visibility).Find(floor, Strengths(scene, light, 7), AtLeast(1));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].kind, DiscontinuityKind::kHorizon);
  EXPECT_EQ(found[0].degree, DiscontinuityDegree::kD1);
  EXPECT_EQ(found[0].weight, 7);
  EXPECT_TRUE(SameSegment(found[0], {2.5, 0}, {2.5, 4}, 1e-12));
}

// Of a floating box only silhouette edges matter: from a point light's view six of its twelve, each once,
// though two faces share it.
TEST(DiscontinuityFinder, OnlySilhouettesCastShadows) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 20, true);
  const PatchId light = AddSquare(scene, {3, 4, 6}, 0.01, false, 1);
  AddBox(scene, {-0.5, -0.5, 1}, {0.5, 0.5, 2}, true);
  const PatchVisibility visibility(scene);
  const auto found =
      DiscontinuityFinder(scene, visibility).Find(floor, Strengths(scene, light, 1), AtLeast(0));
  int ve = 0;
  for (const Discontinuity& d : found)
    if (d.kind == DiscontinuityKind::kVE) ++ve;
  EXPECT_EQ(ve, 4 * 6);
}

// Two boards under a square light, the lower one so that it cuts the upper one's shadow: what is left of each
// line ends where the lower board's edge is seen from the same vertex of the light, by similar triangles;
// with hidden parts kept, the lines run on.
TEST(DiscontinuityFinder, WedgesEndAtTheNextBlocker) {
  constexpr double kL = 0.2, kTall = 4, kHigh = 3, kLow = 1;
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 6, true);
  const PatchId light = AddSquare(scene, {0, 0, kTall}, kL, false, 1);
  // The upper board's sides in y are at +-0.2; the lower board covers what x > 0.1 gets of its shadow.
  AddPatch(scene, {{-0.5, -0.2, kHigh}, {0.5, -0.2, kHigh}, {0.5, 0.2, kHigh}, {-0.5, 0.2, kHigh}});
  AddPatch(scene, {{0.1, -3, kLow}, {3, -3, kLow}, {3, 3, kLow}, {0.1, 3, kLow}});
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  const auto on_floor = [](double from, double through, double high) {
    return 6 + from + (through - from) * kTall / (kTall - high);
  };
  for (const bool keep : {false, true}) {
    DiscontinuityOptions options;
    options.keep_hidden = keep;
    const auto found = finder.Find(floor, Strengths(scene, light, 1), options);
    for (const double lx : {-kL, kL})
      for (const double ly : {-kL, kL})
        for (const double by : {-0.2, 0.2}) {
          const double y = on_floor(ly, by, kHigh), x0 = on_floor(lx, -0.5, kHigh);
          const double x1 = keep ? on_floor(lx, 0.5, kHigh) : on_floor(lx, 0.1, kLow);
          EXPECT_EQ(std::count_if(found.begin(), found.end(),
                                  [&](const Discontinuity& d) {
                                    return d.kind == DiscontinuityKind::kVE && d.blocker == 2 &&
                                           SameSegment(d, {x0, y}, {x1, y}, 1e-12);
                                  }),
                    1)
              << keep << lx << ly << by;
        }
    // The upper board's far side is hidden wholly, also for the light's edges past its corners.
    const auto far = std::count_if(found.begin(), found.end(), [&](const Discontinuity& d) {
      return d.blocker == 2 && std::min(d.end[0].x(), d.end[1].x()) > on_floor(kL, 0.1, kLow) + 1e-9;
    });
    EXPECT_EQ(far > 0, keep);
  }
  // On the lower board the same shadow falls in full.
  const auto above = finder.Find(3, Strengths(scene, light, 1), {});
  EXPECT_GT(std::count_if(above.begin(), above.end(), [](const Discontinuity& d) { return d.blocker == 2; }),
            8);
}

// The borders of umbra and penumbra of a square light over a plane, with one blocker and with two beside each
// other: the outermost and the innermost line on each side, by similar triangles.
TEST(DiscontinuityFinder, UmbraAndPenumbraEndWhereSimilarTrianglesSay) {
  constexpr double kL = 0.25, kTall = 5;
  struct Board {
    double x, half, height;
  };
  for (const std::vector<Board>& boards :
       {std::vector<Board>{{0.3, 0.6, 2}}, std::vector<Board>{{-2, 0.5, 1.25}, {2, 0.7, 2.5}}}) {
    Scene scene = EmptyScene();
    const PatchId floor = AddSquare(scene, {0, 0, 0}, 8, true);
    const PatchId light = AddSquare(scene, {0, 0, kTall}, kL, false, 1);
    for (const Board& board : boards) AddSquare(scene, {board.x, 0, board.height}, board.half, true);
    const PatchVisibility visibility(scene);
    const auto found = DiscontinuityFinder(scene, visibility).Find(floor, Strengths(scene, light, 1), {});
    for (std::size_t i = 0; i < boards.size(); ++i) {
      const Board& board = boards[i];
      std::vector<double> lines;  // x of those along y
      for (const Discontinuity& d : found)
        if (d.blocker == light + 1 + static_cast<PatchId>(i) && std::abs(d.end[0].x() - d.end[1].x()) < 1e-9)
          lines.push_back(d.end[0].x() - 8);
      std::sort(lines.begin(), lines.end());
      ASSERT_GE(lines.size(), 4U);
      const double scale = kTall / (kTall - board.height), shift = kL * board.height / (kTall - board.height);
      const double low = (board.x - board.half) * scale, high = (board.x + board.half) * scale;
      EXPECT_NEAR(lines.front(), low - shift, 1e-12);  // the penumbra's border
      EXPECT_NEAR(lines.back(), high + shift, 1e-12);
      for (const double umbra : {low + shift, high - shift})
        EXPECT_TRUE(
            std::any_of(lines.begin(), lines.end(), [&](double x) { return std::abs(x - umbra) <= 1e-12; }));
      // No line lies between the borders of umbra and penumbra, nor within the umbra.
      for (const double x : lines)
        EXPECT_LE(std::min(std::abs(std::abs(x - board.x * scale) - (high - low) / 2 - shift),
                           std::abs(std::abs(x - board.x * scale) - (high - low) / 2 + shift)),
                  1e-12);
    }
  }
}

// A light flush with the ceiling that is cut out around it: a block's top casts its shadow lines on the floor
// and on the walls, where similar triangles put them, and neither the ceiling nor the walls cast any.
TEST(DiscontinuityFinder, FlushLightCastsShadowLinesOnFloorAndWalls) {
  Scene scene = EmptyScene();
  const PatchId floor = AddPatch(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const PatchId wall = AddPatch(scene, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}});
  AddPatch(scene, {{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}});
  AddPatch(scene, {{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}});
  AddPatch(scene, {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}});
  PatchId light = kNoPatch;
  const std::array<double, 4> cut = {0, 0.35, 0.65, 1};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double x0 = cut[i], x1 = cut[i + 1], y0 = cut[j], y1 = cut[j + 1];
      const PatchId id =
          AddPatch(scene, {{x0, y0, 1}, {x0, y1, 1}, {x1, y1, 1}, {x1, y0, 1}}, i == 1 && j == 1 ? 1 : 0);
      if (i == 1 && j == 1) light = id;
    }
  const PatchId block = AddBox(scene, {0.1, 0.3, 0}, {0.3, 0.7, 0.5}, false);
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  const std::vector<double> strength = Strengths(scene, light, 1);
  for (const PatchId receiver : {floor, wall}) {
    std::size_t lines = 0;
    for (const Discontinuity& d : finder.Find(receiver, strength, {})) {
      if (d.kind == DiscontinuityKind::kContact) continue;
      ++lines;
      EXPECT_EQ(d.source, light);
      EXPECT_GE(d.blocker, block);
      EXPECT_NE(d.kind, DiscontinuityKind::kHorizon);
    }
    EXPECT_GT(lines, 8U) << receiver;
  }
  // From the light's vertex (0.35, 0.35, 1) over the top edge at x = 0.3: on the floor beyond, nothing, since
  // it lies under the block; on the wall over the edge at x = 0.1, at height 1 - 0.5 * 0.35 / 0.25.
  const Frame frame = PolygonFrame(scene.patches[wall].Vertices());
  const double z = 1 - 0.5 * 0.35 / 0.25;
  const double y0 = 0.35 + (0.3 - 0.35) * 0.35 / 0.25, y1 = 0.35 + (0.7 - 0.35) * 0.35 / 0.25;
  const auto found = finder.Find(wall, strength, {});
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Discontinuity& d) {
    return SameSegment(d, frame.ToPlane({0, y0, z}), frame.ToPlane({0, y1, z}), 1e-12);
  }));
}

// A corner whose edges are no silhouettes, or run on straight past it, casts no EV line: the middle of a
// board's side where its two halves meet.
TEST(DiscontinuityFinder, CornersAmidStraightEdgesCastNothing) {
  Scene whole = EmptyScene(), halves = EmptyScene();
  std::array<std::size_t, 2> count = {0, 0};
  int i = 0;
  for (Scene* scene : {&whole, &halves}) {
    const PatchId floor = AddSquare(*scene, {0, 0, 0}, 8, true);
    const PatchId light =
        AddPatch(*scene, {{0.5, 0, 3}, {0.1, -0.4, 3}, {-0.45, 0.05, 3}, {0.05, 0.5, 3}}, 1);
    if (scene == &whole) {
      AddPatch(*scene, {{-1, -0.5, 1}, {1, -0.5, 1}, {1, 0.5, 1}, {-1, 0.5, 1}});
    } else {
      AddPatch(*scene, {{-1, -0.5, 1}, {0, -0.5, 1}, {0, 0.5, 1}, {-1, 0.5, 1}});
      AddPatch(*scene, {{0, -0.5, 1}, {1, -0.5, 1}, {1, 0.5, 1}, {0, 0.5, 1}});
    }
    const PatchVisibility visibility(*scene);
    for (const Discontinuity& d :
         DiscontinuityFinder(*scene, visibility).Find(floor, Strengths(*scene, light, 1), AtLeast(1e-9)))
      count[i] += d.kind == DiscontinuityKind::kEV ? 1 : 0;
    ++i;
  }
  EXPECT_EQ(count[0], 16U);
  EXPECT_EQ(count[1], 16U);
}

}  // namespace
}  // namespace penumbra
