// Exact visibility at a point: against brute force, and what may change nothing.

#include <gtest/gtest.h>

#include <numeric>

#include "solver/scene/surface_points.h"
#include "tests/cases.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// Whether an open segment passes through the patch's interior, computed plainly.
bool Cuts(const Patch& patch, const Vec3& from, const Vec3& to) {
  const double a = patch.normal.dot(from - patch.vertex[0]), b = patch.normal.dot(to - patch.vertex[0]);
  if (std::min(a, b) > -1e-12 || std::max(a, b) < 1e-12) return false;
  const Vec3 p = from + (to - from) * (a / (a - b));
  for (std::int32_t k = 0; k < patch.size; ++k) {
    const Vec3& v = patch.vertex[static_cast<std::size_t>(k)];
    const Vec3& w = patch.vertex[static_cast<std::size_t>((k + 1) % patch.size)];
    if (patch.normal.cross(w - v).dot(p - v) <= 0) return false;
  }
  return true;
}

// A triangle or quadrilateral of a random plane within the cube of half side `half`.
Polygon3 RandomPolygon(Random& random, double half, double radius) {
  const Frame frame = MakeFrame(RandomPoint(random, half), RandomDirection(random));
  const int n = 3 + static_cast<int>(random.Index(2));
  const double start = random.Uniform(0, 6);
  Polygon3 polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = start + (i + random.Uniform(-0.2, 0.2)) * 2 * std::numbers::pi / n;
    polygon.push_back(frame.FromPlane({radius * std::cos(angle), radius * std::sin(angle)}));
  }
  return polygon;
}

// One light and some blockers in random attitudes, cutting each other and the light's plane as they like.
Scene RandomScene(Random& random, int blockers) {
  Scene scene;
  const std::int32_t dark = AddMaterial(scene, 0.5, 0), light = AddMaterial(scene, 0, 1);
  Polygon3 polygon = RandomPolygon(random, 1, 1);
  for (Vec3& v : polygon) v.z() += 3;
  if (VectorArea(polygon).z() > 0) std::reverse(polygon.begin(), polygon.end());
  Add(scene, polygon, light);
  for (int i = 0; i < blockers; ++i) {
    Polygon3 blocker = RandomPolygon(random, 1, random.LogUniform(0.1, 1));
    for (Vec3& v : blocker) v.z() += 1.5;
    Add(scene, blocker, dark);
  }
  return scene;
}

// The light at a point by a fine grid of the source's points, each seen or not: the mean over cells of the
// point-to-point kernel.
double BruteForce(const Scene& scene, const ReceiverPoint& at, int n) {
  double sum = 0;
  for (const Patch& source : scene.patches) {
    const double emittance = scene.materials[source.material].emittance[0];
    if (emittance <= 0) continue;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const Vec3 q = PointOn(source.Vertices(), (i + 0.5) / n, (j + 0.5) / n);
        const Vec3 d = q - at.position;
        const double r2 = d.squaredNorm(), here = at.normal.dot(d), there = -source.normal.dot(d);
        if (here <= 0 || there <= 0) continue;
        bool seen = true;
        for (const Patch& blocker : scene.patches)
          if (&blocker != &source && Cuts(blocker, at.position, q)) {
            seen = false;
            break;
          }
        if (seen) sum += emittance * here * there / (std::numbers::pi * r2 * r2) * source.area / (n * n);
      }
  }
  return sum;
}

// Exact visibility agrees with brute force. 150 x 150 points: the shadows' edges cross some 4 x 150 cells of
// 22,500 a blocker, each half wrong at random: (sqrt(600) / 2) / 22500 < 1e-3 of the unhidden light a
// blocker, and the unhidden light is below 0.3; in all, 4 standard deviations.
TEST(Occlusion, AgreesWithBruteForce) {
  Random random(301);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = RandomScene(random, 1 + static_cast<int>(random.Index(8)));
    const Vec3 normal = (Vec3::UnitZ() + 0.4 * RandomDirection(random)).normalized();
    const ReceiverPoint at = Receiver({random.Uniform(-1, 1), random.Uniform(-1, 1), 0}, normal);
    const double got = Direct(scene, at).irradiance[0], want = BruteForce(scene, at, 150);
    EXPECT_NEAR(got, want, 1.2e-3) << "scene " << i;
    worst = std::max(worst, std::abs(got - want));
  }
  std::printf("seed 301, largest difference %.2g\n", worst);
}

// The same in furnished rooms where everything is aligned with everything.
TEST(Occlusion, AgreesWithBruteForceInFurnishedRooms) {
  Random random(302);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const Scene scene = FurnishedRoom(random, 4);
    const ReceiverPoint at =
        Receiver({random.Uniform(0, 4), random.Uniform(0, 4), random.Index(2) ? 0 : 0.75}, Vec3::UnitZ());
    const double got = Direct(scene, at).irradiance[0], want = BruteForce(scene, at, 100);
    EXPECT_NEAR(got, want, 0.02) << "scene " << i;  // of up to some 3 W/m^2
    worst = std::max(worst, std::abs(got - want));
  }
  std::printf("seed 302, largest difference %.2g\n", worst);
}

// The scene with its lights cut in two.
Scene WithLightsCut(const Scene& scene) {
  Scene light_split = scene;
  light_split.patches.clear();
  for (const Patch& patch : scene.patches) {
    if (scene.materials[patch.material].emittance[0] <= 0) {
      light_split.patches.push_back(patch);
      continue;
    }
    const Vec3 on_edge = 0.3 * patch.vertex[1] + 0.7 * patch.vertex[2];
    const std::size_t last = static_cast<std::size_t>(patch.size) - 1;
    Add(light_split, {patch.vertex[0], patch.vertex[1], on_edge}, patch.material);
    Polygon3 rest = {patch.vertex[0], on_edge, patch.vertex[2]};
    if (last == 3) rest.push_back(patch.vertex[3]);
    Add(light_split, rest, patch.material);
  }
  return light_split;
}

// What must change nothing: the order of the patches, a blocker given twice, a blocker in two triangles, a
// blocker in the light's own plane, one behind the light. What can only take light: one blocker more. 1e-12:
// the same shadow is cut along other edges, with roundings of 1e-16 of 1 m, no nearer than 1e-3.
void ExpectInvariant(const Scene& scene, const ReceiverPoint& at, Random& random, double& worst) {
  const double plain = Direct(scene, at).irradiance[0];
  const auto expect_same = [&](Scene other, const char* what) {
    FindConvexSolids(other);
    const double got = Direct(other, at).irradiance[0];
    EXPECT_NEAR(got, plain, 1e-12) << what;
    worst = std::max(worst, std::abs(got - plain));
  };

  Scene permuted = scene;
  for (std::size_t k = permuted.patches.size(); k > 1; --k)
    std::swap(permuted.patches[k - 1], permuted.patches[random.Index(static_cast<std::uint32_t>(k))]);
  expect_same(permuted, "permuted");

  Scene doubled = scene, split = scene;
  split.patches.clear();
  for (const Patch& patch : scene.patches) {
    doubled.patches.push_back(patch);
    if (scene.materials[patch.material].emittance[0] > 0) {
      doubled.patches.pop_back();
      split.patches.push_back(patch);
    } else if (patch.size == 4) {
      const auto& v = patch.vertex;
      Add(split, {v[0], v[1], v[2]}, patch.material);
      Add(split, {v[0], v[2], v[3]}, patch.material);
    } else {
      const Vec3 middle = 0.5 * (patch.vertex[1] + patch.vertex[2]);
      Add(split, {patch.vertex[0], patch.vertex[1], middle}, patch.material);
      Add(split, {patch.vertex[0], middle, patch.vertex[2]}, patch.material);
    }
  }
  expect_same(doubled, "doubled");
  expect_same(split, "split");
  expect_same(WithLightsCut(scene), "the light split");

  const auto light = std::find_if(scene.patches.begin(), scene.patches.end(), [&](const Patch& patch) {
    return scene.materials[patch.material].emittance[0] > 0;
  });
  Scene coplanar = scene, behind = scene;
  Polygon3 larger, beyond;
  const Vec3 centre = Centroid(light->Vertices());
  for (const Vec3& v : light->Vertices()) {
    larger.push_back(centre + 1.5 * (v - centre));
    beyond.push_back(v - 0.25 * light->normal);
  }
  Add(coplanar, larger, 0);
  Add(behind, beyond, 0);
  expect_same(coplanar, "a blocker in the light's plane");
  expect_same(behind, "a blocker behind the light");

  Scene more = scene;
  Add(more, RandomPolygon(random, 1, 0.5), 0);
  FindConvexSolids(more);
  EXPECT_LE(Direct(more, at).irradiance[0], plain + 1e-13) << "one blocker more";
}

// Turned, shifted and scaled, everything stays the same: 1e-12, since coordinates of some 5 m are rounded by
// 1e-15, seen from no nearer than 1e-2 m.
void ExpectSameAnywhere(const Scene& scene, const ReceiverPoint& at, Random& random, double& worst) {
  const double plain = Direct(scene, at).irradiance[0];
  const Motion motion = RandomMotion(random, 5);
  const double scale = random.LogUniform(1e-6, 1e6);
  const Scene moved = Mapped(scene, motion),
              scaled = Mapped(scene, [&](const Vec3&p) { return Vec3(scale * p); });
  const double got_moved =
      Direct(moved, Receiver(motion(at.position), motion.turn * at.normal)).irradiance[0];
  const double got_scaled = Direct(scaled, Receiver(scale * at.position, at.normal)).irradiance[0];
  EXPECT_NEAR(got_moved, plain, 1e-12);
  EXPECT_NEAR(got_scaled, plain, 1e-12) << "scaled by " << scale;
  worst = std::max({worst, std::abs(got_moved - plain), std::abs(got_scaled - plain)});
}

// Ten variants of each scene.
TEST(Occlusion, InvariantsOfRandomScenes) {
  Random random(303);
  double worst = 0, worst_moved = 0;
  for (int i = 0; i < CaseCount(4000); ++i) {
    SCOPED_TRACE("scene " + std::to_string(i));
    const Scene scene = RandomScene(random, 1 + static_cast<int>(random.Index(10)));
    const ReceiverPoint at = Receiver({random.Uniform(-1, 1), random.Uniform(-1, 1), 0}, Vec3::UnitZ());
    ExpectInvariant(scene, at, random, worst);
    ExpectSameAnywhere(scene, at, random, worst_moved);
  }
  std::printf("seed 303, largest change %.2g, moved or scaled %.2g\n", worst, worst_moved);
}

// The same in furnished rooms, in place and turned, at points that the blockers' edges and planes go through.
TEST(Occlusion, InvariantsOfFurnishedRooms) {
  Random random(304);
  double worst = 0;
  for (int i = 0; i < CaseCount(150); ++i) {
    SCOPED_TRACE("room " + std::to_string(i));
    const Scene room = FurnishedRoom(random, 4);
    const Motion motion = i % 2 == 0 ? Motion() : RandomMotion(random, 5);
    const Scene scene = Mapped(room, motion);
    for (int k = 0; k < 4; ++k) {
      const double step = k < 2 ? 0.25 : 0.03125;
      const Vec3 p(step * (1 + random.Index(static_cast<std::uint32_t>(4 / step) - 1)),
                   step * (1 + random.Index(static_cast<std::uint32_t>(4 / step) - 1)),
                   k % 2 == 0 ? 0 : 0.25);
      // At a point of the grid a turned room's own rounding decides on which side a wall lies.
      if (i % 2 == 1 && k < 2) continue;
      ExpectInvariant(scene, Receiver(motion(p), motion.turn * Vec3::UnitZ()), random, worst);
    }
  }
  std::printf("seed 304, largest change %.2g\n", worst);
}

// A blocker across the light's plane hides what its part before the plane hides, and nothing more.
TEST(Occlusion, BlockerAcrossTheLightsPlane) {
  Random random(305);
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    Scene whole;
    AddMaterial(whole, 0.5, 0);
    const std::int32_t light = AddMaterial(whole, 0, 1);
    Add(whole, {{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, light);
    Scene part = whole;
    Polygon3 blocker = RandomPolygon(random, 0.5, 1);
    for (Vec3& v : blocker) v.z() += 2;
    Add(whole, blocker, 0);
    const Polygon3 before = ClipToHalfSpace(blocker, -Vec3::UnitZ(), Vec3(0, 0, 2));
    for (std::size_t k = 2; k < before.size(); ++k) Add(part, {before[0], before[k - 1], before[k]}, 0);
    const ReceiverPoint at = Receiver({random.Uniform(-1, 1), random.Uniform(-1, 1), 0}, Vec3::UnitZ());
    worst = std::max(worst, std::abs(Direct(whole, at).irradiance[0] - Direct(part, at).irradiance[0]));
  }
  std::printf("seed 305, largest difference %.2g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

// Inside a closed box nothing comes in from outside, however near the point is to a foot, an edge or a
// corner.
TEST(Occlusion, ClosedBoxesLeakNothing) {
  Random random(306);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    Scene plain;
    AddMaterial(plain, 0.5, 0);
    const std::int32_t light = AddMaterial(plain, 0, 1);
    AddBox(plain, {-2, -2, 0}, {2, 2, 2}, true, {0, light, light, light, light, light});
    AddBox(plain, {-0.5, -0.5, 0}, {0.5, 0.5, 0.5}, false, 0);
    const Motion motion = RandomMotion(random, 3);
    const Scene scene = Mapped(plain, motion);
    const auto near_wall = [&] {
      const double d = random.LogUniform(1e-9, 0.5);
      return random.Index(2) == 0 ? 0.5 - d : -0.5 + d;
    };
    const double x = near_wall(), y = random.Index(2) == 0 ? near_wall() : random.Uniform(-0.4, 0.4);
    const double leak = Direct(scene, Receiver(motion({x, y, 0}), motion.turn * Vec3::UnitZ())).irradiance[0];
    worst = std::max(worst, leak);
  }
  // Edges are where they are to 1e-15 m; 1e-9 m from one that is an angle of 1e-6.
  std::printf("seed 306, largest leak %.2g\n", worst);
  EXPECT_LE(worst, 1e-6);
}

// At interior points of patches the candidates of PatchVisibility give what all patches as candidates give:
// its tubes drop no source and no blocker.
TEST(Occlusion, OnPatchIsAnywhere) {
  Random random(307);
  double worst = 0;
  int points = 0;
  for (int i = 0; i < 60; ++i) {
    Scene scene = FurnishedRoom(random, 5);
    if (i % 2 == 1) scene = Mapped(scene, RandomMotion(random, 5));
    for (Material& material : scene.materials) material.emittance = Rgb::Constant(1);
    const PatchVisibility visibility(scene);
    const SourceSet sources = SourceSet::Emitters(scene);
    const PointIrradiance irradiance(scene, visibility, sources);
    for (const SurfacePoint& p : SpreadPoints(scene, 60, 40 + static_cast<std::uint64_t>(i))) {
      // Overlapping boxes hide parts of patches in the planes of others: such points see either side.
      const ReceiverPoint at = Receiver(p.position, scene.patches[p.patch].normal);
      const double on = irradiance.OnPatch(p.patch, at).irradiance[0];
      const double anywhere = irradiance.Anywhere(at).irradiance[0];
      EXPECT_NEAR(on, anywhere, 1e-12)
          << "room " << i << " patch " << p.patch << " at " << p.position.transpose();
      worst = std::max(worst, std::abs(on - anywhere));
      ++points;
    }
  }
  std::printf("seed 307, %d points, largest difference %.2g\n", points, worst);
}

}  // namespace
}  // namespace penumbra::scene_test
