#include "mesh/discontinuity.h"

#include <gtest/gtest.h>

#include <algorithm>
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

bool SameSegment(const Discontinuity& d, const Vec2& a, const Vec2& b, double tolerance) {
  const auto near = [&](const Vec2& p, const Vec2& q) { return (p - q).norm() <= tolerance; };
  return (near(d.end[0], a) && near(d.end[1], b)) || (near(d.end[0], b) && near(d.end[1], a));
}

// A square light (half side l, height H) over a plane with a floating square blocker (half side b, height h):
// seen through each corner of the light the blocker's shadow is a square of half side b H / (H - h), moved
// against the corner by l h / (H - h). The boundaries of umbra and penumbra are among their sides, by similar
// triangles.
TEST(DiscontinuityFinder, SquareLightAndBlockerCastSquares) {
  constexpr double kL = 0.3, kB = 0.5, kTall = 3, kLow = 1.25;
  for (const double degrees : {0.0, 20.0}) {
    Scene scene = EmptyScene();
    const PatchId floor = AddSquare(scene, 0, 0, 0, 4, true);
    const PatchId light = AddSquare(scene, 0, 0, kTall, kL, false, 1);
    AddSquare(scene, 0, 0, kLow, kB, true);
    Tilt(scene, degrees);
    const PatchVisibility visibility(scene);
    const DiscontinuityFinder finder(scene, visibility);
    const std::vector<Discontinuity> found = finder.Find(floor, Strengths(scene, light, 10), 0);
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
  const PatchId floor = AddSquare(scene, 0, 0, 0, 4, true);
  const PatchId light = AddSquare(scene, 0.1, 0.2, 3, 0.3, false, 1);
  AddSquare(scene, 0, 0, 2.5, 0.2, true);
  AddSquare(scene, 0, 0, 0.5, 0.3, true);
  const PatchVisibility visibility(scene);
  const DiscontinuityFinder finder(scene, visibility);
  EXPECT_TRUE(finder.Find(floor, Strengths(scene, light, 10), 10.5).empty());
  const auto all = finder.Find(floor, Strengths(scene, light, 10), 0);
  const auto strong = finder.Find(floor, Strengths(scene, light, 10), 5);
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
      const PatchId floor = AddSquare(scene, 0, 0, 0, 2, true);
      AddBox(scene, {-0.5, -0.3, 0}, {0.7, 0.4, 1}, bottom);
      Tilt(scene, degrees);
      const PatchVisibility visibility(scene);
      const DiscontinuityFinder finder(scene, visibility);
      const auto found = finder.Find(floor, std::vector<double>(scene.patches.size(), 0.0), 0);
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
  const PatchId floor = AddSquare(scene, 0, 0, 0, 2, true);
  AddPatch(scene, {{-2, -2, 0}, {-2, 2, 0}, {-2, 2, 2}, {-2, -2, 2}});
  AddSquare(scene, 0, 0, 2, 2, false);
  AddBox(scene, {-0.5, -0.3, -1}, {0.7, 0.4, 0}, true);
  const PatchVisibility visibility(scene);
  // Its lid looks the same way as the floor and lies in its plane.
  EXPECT_TRUE(DiscontinuityFinder(scene, visibility)
                  .Find(floor, std::vector<double>(scene.patches.size(), 0.0), 0)
                  .empty());
  AddPatch(scene, {{0, -1, -0.5}, {0, 1, -0.5}, {0, 1, 0.5}, {0, -1, 0.5}});
  const PatchVisibility after(scene);
  const auto found =
      DiscontinuityFinder(scene, after).Find(floor, std::vector<double>(scene.patches.size(), 0.0), 0);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(SameSegment(found[0], {2, 1}, {2, 3}, 1e-12));
}

// A light whose plane cuts the floor lights it up to that line only: a D1 horizon of geometric weight 1.
TEST(DiscontinuityFinder, SourcePlaneCutsReceiver) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, 0, 0, 0, 2, true);
  // Leaning: its plane is x = 0.5 - 0.25 z.
  const PatchId light = AddPatch(scene, {{0.25, -0.2, 1}, {0.25, 0.2, 1}, {0, 0.2, 2}, {0, -0.2, 2}}, 1);
  const PatchVisibility visibility(scene);
  const auto found = DiscontinuityFinder(scene, visibility).Find(floor, Strengths(scene, light, 7), 1);
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
  const PatchId floor = AddSquare(scene, 0, 0, 0, 20, true);
  const PatchId light = AddSquare(scene, 3, 4, 6, 0.01, false, 1);
  AddBox(scene, {-0.5, -0.5, 1}, {0.5, 0.5, 2}, true);
  const PatchVisibility visibility(scene);
  const auto found = DiscontinuityFinder(scene, visibility).Find(floor, Strengths(scene, light, 1), 0);
  int ve = 0;
  for (const Discontinuity& d : found)
    if (d.kind == DiscontinuityKind::kVE) ++ve;
  EXPECT_EQ(ve, 4 * 6);
}

}  // namespace
}  // namespace penumbra
