#include "mesh/discontinuities/irradiance_jump.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "mesh/discontinuities/dset.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "mesh_test_scenes.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::Tilt;

// What emitters alone send, in the first channel.
std::vector<double> EmitterStrengths(const Scene& scene) {
  std::vector<double> strength;
  for (const Patch& patch : scene.patches) strength.push_back(scene.materials[patch.material].emittance[0]);
  return strength;
}

// Exact direct irradiance on a scene's patches, and how its derivatives jump, by differences of exact
// gradients.
class DirectLight {
 public:
  explicit DirectLight(const Scene& scene)
      : scene_(scene), visibility_(scene), irradiance_(scene, visibility_, SourceSet::Emitters(scene)) {}

  const PatchVisibility& visibility() const { return visibility_; }

  // The first channel's derivative along `across` [W/m^3].
  double Slope(PatchId patch, const Vec3& x, const Vec3& across) const {
    ReceiverPoint at;
    at.position = x;
    at.normal = scene_.patches[patch].normal;
    IrradianceParts parts;
    irradiance_.OnPatch(patch, at, &parts);
    return parts.gradient.row(0).dot(across);
  }

  // From the one side to the other, one-sided from two points each: the error is of the order of `step`.
  struct Jumps {
    double gradient, curvature;
  };
  Jumps Measure(PatchId patch, const Vec3& x, const Vec3& across, double step) const {
    std::array<double, 4> slope;
    const std::array<double, 4> at = {-2, -1, 1, 2};
    for (int i = 0; i < 4; ++i) slope[i] = Slope(patch, x + at[i] * step * across, across);
    return {(2 * slope[2] - slope[3]) - (2 * slope[1] - slope[0]),
            ((slope[3] - slope[2]) - (slope[1] - slope[0])) / step};
  }

 private:
  const Scene& scene_;
  PatchVisibility visibility_;
  PointIrradiance irradiance_;
};

// The estimates of all discontinuities on one line add up, where they hold there; a D1 event of the same two
// edges is found from several of their ends and counts once.
struct Estimate {
  double gradient = 0, curvature = 0;
  std::vector<std::array<std::int32_t, 4>> edges;

  void Add(const DiscontinuityFinder& finder, const Discontinuity& d, const Vec2& at, const Vec2& direction) {
    const IrradianceJump jump = finder.Jump(d, at);
    if (d.degree == DiscontinuityDegree::kD1) {
      const std::array<std::int32_t, 4> key = {d.source, d.shared_source_edge, d.shared_blocker_edge.patch,
                                               d.shared_blocker_edge.k};
      if (std::find(edges.begin(), edges.end(), key) != edges.end()) return;
      edges.push_back(key);
      gradient += jump.gradient * d.strength;
    } else {
      // The jump of an odd derivative does not know left from right, that of an even one does.
      curvature += (d.end[1] - d.end[0]).dot(direction) >= 0 ? jump.curvature * d.strength
                                                             : -jump.curvature * d.strength;
    }
  }
};

// A turned square over a floor under a turned square light: at the middle of every VE and EV segment the
// second derivative of the exact irradiance jumps by the estimate, and the gradient not at all; between the
// segments neither jumps.
TEST(JumpAt, GenericEventsAreSecondDegree) {
  for (const bool box : {false, true}) {
    Scene scene = EmptyScene();
    const PatchId floor = AddSquare(scene, {0, 0, 0}, 4, true);
    AddPatch(scene, {{0.5, 0, 3}, {0.1, -0.4, 3}, {-0.45, 0.05, 3}, {0.05, 0.5, 3}}, 1);
    if (box) {
      AddBox(scene, {-0.4, -0.5, 0.8}, {0.5, 0.3, 1.3}, true);
    } else {
      AddPatch(scene, {{-0.4, -0.5, 1}, {0.6, -0.45, 1.2}, {0.5, 0.4, 1.1}});
    }
    const DirectLight light(scene);
    const DiscontinuityFinder finder(scene, light.visibility());
    const std::vector<Discontinuity> found = finder.Find(floor, EmitterStrengths(scene), {});
    const Frame frame = PolygonFrame(scene.patches[floor].Vertices());
    ASSERT_GT(found.size(), 20U);
    // Segments may cross near the middle of another: as far as that does not happen, the step is small
    // enough.
    constexpr double kStep = 1e-5;
    double worst = 0, largest = 0;
    int measured = 0;
    for (const Discontinuity& d : found) {
      EXPECT_EQ(d.degree, DiscontinuityDegree::kD2);
      const Vec2 along = (d.end[1] - d.end[0]).normalized(), across(-along.y(), along.x());
      const Vec2 middle = 0.45 * d.end[0] + 0.55 * d.end[1];
      const bool crossed = std::any_of(found.begin(), found.end(), [&](const Discontinuity& other) {
        if (&other == &d) return false;
        const Vec2 a = other.end[0] - middle, b = other.end[1] - middle, ab = b - a;
        const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        return (a + t * ab).norm() < 4 * kStep;
      });
      if (crossed) continue;
      ++measured;
      const Vec3 x = frame.FromPlane(middle), n = across.x() * frame.u + across.y() * frame.v;
      const DirectLight::Jumps jump = light.Measure(floor, x, n, kStep);
      const double estimate = finder.Jump(d, middle).curvature;
      largest = std::max(largest, std::abs(estimate));
      worst = std::max(worst, std::abs(jump.curvature - estimate));
      EXPECT_NEAR(jump.curvature, estimate, 0.01 * std::abs(estimate) + 2e-3)
          << (d.kind == DiscontinuityKind::kVE ? "VE " : "EV ") << d.source_part << ", " << d.blocker_part;
      EXPECT_LT(std::abs(jump.gradient), 1e-4);
    }
    // A step off a segment nothing jumps.
    Random random(5);
    for (int i = 0; i < 300; ++i) {
      const Vec2 p(4 + random.Uniform(-1.5, 1.5), 4 + random.Uniform(-1.5, 1.5));
      const bool clear = std::none_of(found.begin(), found.end(), [&](const Discontinuity& d) {
        const Vec2 ab = d.end[1] - d.end[0], a = d.end[0] - p;
        const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        return (a + t * ab).norm() < 4 * kStep;
      });
      if (!clear) continue;
      EXPECT_LT(std::abs(light.Measure(floor, frame.FromPlane(p), frame.u, kStep).curvature), 4e-3);
      EXPECT_LT(std::abs(light.Measure(floor, frame.FromPlane(p), frame.v, kStep).curvature), 4e-3);
    }
    std::printf("%d of %zu segments: worst error %.2g, largest jump %.3g\n", measured, found.size(), worst,
                largest);
    EXPECT_GT(measured, 10);
  }
}

// Where three edges appear to meet, the second derivative jumps by the area of the triangle that comes or
// goes between them: two triangles under a turned light, and three boards with a hole between them before the
// inside of a light, at points of the curves between two pieces.
TEST(JumpAt, TripleEdgesAreSecondDegree) {
  Scene triangles = EmptyScene();
  AddSquare(triangles, {0, 0, 0}, 8, true);
  AddPatch(triangles, {{0.5, 0, 4}, {0.1, -0.4, 4}, {-0.45, 0.05, 4}, {0.05, 0.5, 4}}, 1);
  AddPatch(triangles, {{-0.9, -0.9, 2.0}, {1.0, -0.7, 2.4}, {0.1, 0.35, 2.6}});
  AddPatch(triangles, {{-0.8, 0.5, 1.2}, {0.1, -0.6, 1.0}, {0.9, 0.7, 1.5}});
  for (const bool hole : {false, true}) {
    const Scene scene = hole ? mesh_test::ThreeBoards(3) : triangles;
    const PatchId floor = 0;
    const DirectLight light(scene);
    const DiscontinuityFinder finder(scene, light.visibility());
    DiscontinuityOptions options;
    options.triple_edge_tolerance = 1e-5;
    const std::vector<Discontinuity> found = finder.Find(floor, EmitterStrengths(scene), options);
    const Frame frame = PolygonFrame(scene.patches[floor].Vertices());
    constexpr double kStep = 1e-5;
    double worst = 0, largest = 0;
    int measured = 0, grows = 0;
    for (std::size_t i = 0; i + 1 < found.size(); ++i) {
      const Discontinuity &d = found[i], &next = found[i + 1];
      if (d.kind != DiscontinuityKind::kEEE || d.end[1] != next.end[0]) continue;
      if (hole && d.source_part >= 0) continue;
      const Vec2 along = (next.end[1] - d.end[0]).normalized(), across(-along.y(), along.x()), x = d.end[1];
      const bool crossed = std::any_of(found.begin(), found.end(), [&](const Discontinuity& other) {
        if (&other == &d || &other == &next) return false;
        const Vec2 a = other.end[0] - x, b = other.end[1] - x, ab = b - a;
        const double t = std::clamp(-a.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
        return (a + t * ab).norm() < 5 * kStep;
      });
      if (crossed) continue;
      ++measured;
      const DirectLight::Jumps jump =
          light.Measure(floor, frame.FromPlane(x), across.x() * frame.u + across.y() * frame.v, kStep);
      const double estimate = finder.Jump(d, x).curvature;
      grows += estimate > 0 ? 1 : 0;
      largest = std::max(largest, std::abs(estimate));
      worst = std::max(worst, std::abs(jump.curvature - estimate));
      EXPECT_NEAR(jump.curvature, estimate, 0.02 * std::abs(estimate) + (hole ? 1e-4 : 2e-3));
      EXPECT_LT(std::abs(jump.gradient), 1e-4);
    }
    std::printf("%d points: worst error %.2g, largest jump %.3g, %d upwards\n", measured, worst, largest,
                grows);
    EXPECT_GT(measured, 50);
  }
}

// Where edges of light and blocker are parallel the gradient itself jumps, by the estimate; and across a
// horizon too.
TEST(JumpAt, SharedPlanesAreFirstDegree) {
  Scene scene = EmptyScene();
  const PatchId floor = AddSquare(scene, {0, 0, 0}, 4, true);
  AddSquare(scene, {0, 0, 3}, 0.3, false, 1);
  AddSquare(scene, {0.1, 0.15, 1.25}, 0.5, true);
  Tilt(scene, 20);
  const DirectLight light(scene);
  const DiscontinuityFinder finder(scene, light.visibility());
  const auto found = finder.Find(floor, EmitterStrengths(scene), {});
  const Frame frame = PolygonFrame(scene.patches[floor].Vertices());
  int first = 0;
  for (const Discontinuity& d : found) {
    const Vec2 along = (d.end[1] - d.end[0]).normalized(), across(-along.y(), along.x());
    const Vec2 middle = 0.45 * d.end[0] + 0.55 * d.end[1];
    Estimate estimate;
    for (const Discontinuity& other : found)
      if (std::abs(Cross2(along, other.end[0] - middle)) < 1e-9 &&
          std::abs(Cross2(along, other.end[1] - middle)) < 1e-9)
        estimate.Add(finder, other, middle, along);
    if (estimate.edges.empty()) continue;
    ++first;
    const auto jump =
        light.Measure(floor, frame.FromPlane(middle), across.x() * frame.u + across.y() * frame.v, 1e-5);
    EXPECT_NEAR(jump.gradient, estimate.gradient, 0.02 * std::abs(estimate.gradient) + 1e-4);
  }
  EXPECT_EQ(first, 32);

  Scene leaning = EmptyScene();
  const PatchId below = AddSquare(leaning, {0, 0, 0}, 2, true);
  AddPatch(leaning, {{0.25, -0.2, 1}, {0.25, 0.2, 1}, {0, 0.2, 2}, {0, -0.2, 2}}, 1);
  const DirectLight lamp(leaning);
  const DiscontinuityFinder horizon(leaning, lamp.visibility());
  const auto lines = horizon.Find(below, EmitterStrengths(leaning), {});
  ASSERT_EQ(lines.size(), 1U);
  const Frame plane = PolygonFrame(leaning.patches[below].Vertices());
  for (const double t : {0.1, 0.3, 0.5, 0.8}) {
    const Vec2 at = (1 - t) * lines[0].end[0] + t * lines[0].end[1];
    const auto jump = lamp.Measure(below, plane.FromPlane(at), plane.u, 1e-4);
    EXPECT_NEAR(jump.gradient, horizon.Jump(lines[0], at).gradient, 0.01 * jump.gradient);
  }
}

// On the office, of the mesh's edges that come from the emitters (as the thesis's weight ranks them): the
// estimated jump is within a factor of two of the measured one for 95 % of them.
TEST(JumpAt, EstimatesHoldInTheOffice) {
  const Scene scene = *LoadBuiltinScene("office", {});
  const DirectLight light(scene);
  const DiscontinuityFinder finder(scene, light.visibility());
  const std::vector<double> strength = EmitterStrengths(scene);
  ElementForest forest(scene);
  DiscontinuityOptions options;
  options.min_weight = 0.1 * *std::max_element(strength.begin(), strength.end());
  std::size_t edges = 0, within = 0;
  std::map<std::pair<int, int>, std::size_t> beyond;
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p) {
    // Leaves of the size that a solution has: a sixteenth of the patch's sides.
    for (int level = 0; level < 3; ++level)
      for (const ElementId leaf : forest.Leaves(p)) forest.Subdivide(leaf);
    const std::vector<Discontinuity> found = finder.Find(p, strength, options);
    const PatchDSets dsets = ActivateDiscontinuities(forest, p, found, options);
    const PatchTriangulation mesh = TriangulateLeaves(forest, p, dsets);
    const Frame frame = PolygonFrame(scene.patches[p].Vertices());
    const double snap = SnapDistance(scene.patches[p]);
    for (const PatchTriangulation::Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        if (t.line[k] == kNoLine || t.contact[k] || t.vertex[k] > t.vertex[(k + 1) % 3]) continue;
        const Vec2 &a = mesh.in_plane[t.vertex[k]], &b = mesh.in_plane[t.vertex[(k + 1) % 3]];
        const double length = (b - a).norm();
        constexpr double kStep = 2e-5;  // [m]
        if (length < 100 * kStep) continue;
        const DiscontinuityLine& line = dsets.lines[t.line[k]];
        const Vec2 middle = 0.47 * a + 0.53 * b;
        Estimate estimate;
        bool covered = false;
        for (const Discontinuity& d : found) {
          if (std::abs(line.Distance(d.end[0])) > snap || std::abs(line.Distance(d.end[1])) > snap) continue;
          const double at = line.Along(middle), t0 = line.Along(d.end[0]), t1 = line.Along(d.end[1]);
          if (at < std::min(t0, t1) || at > std::max(t0, t1)) continue;
          covered = true;
          estimate.Add(finder, d, middle, line.direction);
        }
        if (!covered) continue;  // of the hull only
        const Vec2 n(-line.direction.y(), line.direction.x());
        const DirectLight::Jumps measured =
            light.Measure(p, frame.FromPlane(middle), n.x() * frame.u + n.y() * frame.v, kStep);
        const bool first = !estimate.edges.empty();
        const double got = std::abs(first ? estimate.gradient : estimate.curvature);
        const double want = std::abs(first ? measured.gradient : measured.curvature);
        ++edges;
        const bool holds = got <= 2 * want && want <= 2 * got;
        within += holds ? 1 : 0;
        if (!holds) ++beyond[{first, got > want ? 1 : 0}];
      }
  }
  std::printf("%zu edges, %zu within a factor of two (%.2f %%)\n", edges, within,
              100.0 * static_cast<double>(within) / static_cast<double>(edges));
  for (const auto& [kind, count] : beyond)
    std::printf("  %s, %s: %zu\n", kind.first ? "D1" : "D2", kind.second ? "too large" : "too small", count);
  EXPECT_GE(static_cast<double>(within), 0.95 * static_cast<double>(edges));
}

}  // namespace
}  // namespace penumbra
