#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <memory>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/refinement/local_pass.h"
#include "mesh_test_scenes.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

using mesh_test::AddBox;
using mesh_test::AddPatch;
using mesh_test::AddSquare;
using mesh_test::EmptyScene;
using mesh_test::RefineAtRandom;
using mesh_test::Segment;

Rgb SomeQuadratic(const Vec3& p) {
  const double x = p.x(), y = p.y();
  return {1 + x - 2 * y + 3 * x * x - x * y + 0.5 * y * y, 2 - x * y, x * x + y};
}

// One patch, a random quadtree, random discontinuities.
struct RandomMesh {
  explicit RandomMesh(std::uint64_t seed, bool triangle = false) : scene(EmptyScene()) {
    Random random(seed);
    if (triangle) {
      AddPatch(scene, {{0, 0, 0}, {2, 0.3, 0}, {0.4, 1.5, 0}});
    } else {
      AddPatch(scene, {{0, 0, 0}, {2, 0.3, 0}, {1.8, 1.5, 0}, {0.1, 1.2, 0}});
    }
    forest = ElementForest(scene);
    RefineAtRandom(forest, 0, random, 20, 5);
    std::vector<Discontinuity> found;
    for (int i = 0; i < 8; ++i)
      found.push_back(Segment({random.Uniform(0, 2), random.Uniform(0, 1.5)},
                              {random.Uniform(0, 2), random.Uniform(0, 1.5)}, random.Uniform()));
    patches = {TriangulateLeaves(forest, 0, ActivateDiscontinuities(forest, 0, found, {}))};
  }
  Scene scene;
  ElementForest forest;
  std::vector<PatchTriangulation> patches;
};

// A quadratic irradiance is reproduced everywhere, and each node is evaluated once: as many evaluations as
// the mesh has vertices and edges.
TEST(BuildIrradianceMesh, QuadraticsAreReproduced) {
  constexpr double kAboveZero = 100;  // what is shown is never negative
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMesh random_mesh(seed, seed % 2 == 0);
    std::atomic<std::size_t> calls = 0;
    const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
      ++calls;
      return PointIrradianceResult{SomeQuadratic(at.position) + kAboveZero, false};
    };
    const BuiltMesh built = BuildIrradianceMesh(random_mesh.scene, random_mesh.patches,
                                                InterpolantOrder::kQuadratic, sampler, ExecutionContext());
    EXPECT_EQ(built.point_evaluations, calls);
    // A disc: vertices - edges + triangles = 1, of the vertices that are used.
    std::vector<bool> used(built.mesh.positions.size(), false);
    for (const auto& t : built.mesh.triangles)
      for (const std::uint32_t v : t.vertex) used[v] = true;
    const auto vertices = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
    EXPECT_EQ(calls, vertices + (vertices + built.mesh.triangles.size() - 1));
    const RepresentationError error =
        MeasureRepresentationError(random_mesh.scene, built.mesh, sampler, 500, seed);
    EXPECT_EQ(error.points, 500U);
    EXPECT_LT(error.max, 1e-12);
  }
}

// Gouraud samples vertices only, and reproduces what is linear.
TEST(BuildIrradianceMesh, LinearOrderReproducesLinearFunctions) {
  const RandomMesh random_mesh(5);
  const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
    return PointIrradianceResult{Rgb(1 + at.position.x(), 2 + at.position.y(), 3), false};
  };
  const BuiltMesh built = BuildIrradianceMesh(random_mesh.scene, random_mesh.patches,
                                              InterpolantOrder::kLinear, sampler, ExecutionContext());
  EXPECT_LE(built.point_evaluations, built.mesh.positions.size());
  EXPECT_LT(MeasureRepresentationError(random_mesh.scene, built.mesh, sampler, 500, 1).max, 1e-13);
}

// Of the constant basis every triangle shows its leaf's irradiance.
TEST(BuildConstantMesh, ShowsTheLeaf) {
  const RandomMesh random_mesh(6);
  std::vector<Rgb> irradiance;
  for (std::size_t i = 0; i < random_mesh.forest.size(); ++i)
    irradiance.push_back(Rgb::Constant(static_cast<double>(i)));
  const IrradianceMesh mesh = BuildConstantMesh(random_mesh.patches, irradiance);
  ASSERT_EQ(mesh.irradiance.size(), mesh.triangles.size());
  const MeshLocator locator(random_mesh.scene, mesh);
  for (const ElementId leaf : random_mesh.forest.Leaves(0)) {
    const auto at = locator.Find(0, Centroid(random_mesh.forest[leaf].Vertices()));
    ASSERT_TRUE(at.has_value());
    EXPECT_EQ(IrradianceAt(mesh, *at)[0], static_cast<double>(leaf));
  }
}

// An irradiance that jumps across a contact is sampled from either side: exact up to the line, nothing leaks.
TEST(BuildIrradianceMesh, JumpsAcrossContactsAreSharp) {
  for (const Vec2& end : {Vec2(1.7, 1.4), Vec2(0.9, 1.1)}) {
    Scene scene = EmptyScene();
    AddPatch(scene, {{0, 0, 0}, {2, 0, 0}, {2, 1.5, 0}, {0, 1.5, 0}});
    ElementForest forest(scene);
    Random random(4);
    RefineAtRandom(forest, 0, random, 20, 5);
    const Vec2 start(0.2, 0.1), direction = (end - start).normalized();
    const std::vector<Discontinuity> found = {Segment(start, end, kInfiniteWeight, DiscontinuityDegree::kD0)};
    const std::vector<PatchTriangulation> patches = {
        TriangulateLeaves(forest, 0, ActivateDiscontinuities(forest, 0, found, {}))};
    // Brighter by 10 on the left of the contact, which is felt between its ends only.
    const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
      PointIrradianceResult result;
      result.irradiance = SomeQuadratic(at.position);
      const Vec2 p = at.position.head<2>() - start;
      const double along = direction.dot(p), across = Cross2(direction, p);
      const double length = (end - start).norm();
      const bool beside = along >= -at.uncertainty && along <= length + at.uncertainty;
      const bool on = beside && std::abs(across) <= at.uncertainty;
      const bool left = on ? Cross2(direction, at.approach.head<2>()) > 0 : across > 0;
      if (along > 0 && along < length && left && std::abs(across) < 1e-6) result.irradiance += 10;
      result.one_sided = on;
      return result;
    };
    const BuiltMesh built =
        BuildIrradianceMesh(scene, patches, InterpolantOrder::kQuadratic, sampler, ExecutionContext());
    // The value that a triangle has in the middle of its contact edge is that of its own side.
    int left_edges = 0, right_edges = 0;
    for (std::size_t t = 0; t < built.mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        if (!patches[0].triangles[t].contact[k]) continue;
        const auto& v = built.mesh.triangles[t].vertex;
        const Vec3 a = built.mesh.positions[v[k]], b = built.mesh.positions[v[(k + 1) % 3]];
        // Its triangle lies on the left of a counter-clockwise edge.
        const bool left = direction.dot((b - a).head<2>()) > 0;
        (left ? left_edges : right_edges)++;
        const auto& at = kSampleAt[2 * k + 1];
        const Rgb expected = SomeQuadratic(0.5 * (a + b)) + (left ? 10.0 : 0.0);
        EXPECT_LT((built.mesh.irradiance[t].At(at[0], at[1]) - expected).abs().maxCoeff(), 1e-12);
      }
    EXPECT_GT(left_edges, 0);
    EXPECT_EQ(left_edges, right_edges);
  }
}

// Every point of a patch is found, at its corners, on its outline and a rounding beyond, in a triangle that
// holds it; points beyond the tolerance are not.
TEST(MeshLocator, FindsPointsUpToTheOutline) {
  const RandomMesh random_mesh(9);
  const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
    return PointIrradianceResult{Rgb(at.position.x(), at.position.y(), 1), false};
  };
  const BuiltMesh built = BuildIrradianceMesh(random_mesh.scene, random_mesh.patches,
                                              InterpolantOrder::kLinear, sampler, ExecutionContext());
  const MeshLocator locator(random_mesh.scene, built.mesh);
  const Patch& patch = random_mesh.scene.patches[0];
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const int k = static_cast<int>(random.Index(4));
    const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % 4];
    Vec3 p = a + (i % 3 == 0 ? 0.0 : random.Uniform()) * (b - a);
    if (i % 2 == 0) p += random.Uniform() * (Centroid(patch.Vertices()) - p);
    const Vec3 outward = (b - a).cross(patch.normal).normalized();
    if (i % 2 == 1) p += random.Uniform(-1e-15, 1e-15) * outward;
    const auto at = locator.Find(0, p);
    ASSERT_TRUE(at.has_value()) << p.transpose();
    EXPECT_TRUE(at->s >= 0 && at->t >= 0 && at->s + at->t <= 1);
    const Rgb value = IrradianceAt(built.mesh, *at);
    worst = std::max(worst, std::hypot(value[0] - p.x(), value[1] - p.y()));
    EXPECT_FALSE(locator.Find(0, 0.5 * (a + b) + 1e-6 * outward).has_value());
    EXPECT_TRUE(locator.Find(0, 0.5 * (a + b) + 1e-6 * outward, 1e-5).has_value());
  }
  EXPECT_LT(worst, 1e-13);
}

// A box on a floor under a square light, and one that floats, all tilted; quadtrees of three levels, direct
// light only.
struct BoxesUnderLight {
  // `decimals`: how far coordinates are rounded, as in a file; 0 leaves them.
  explicit BoxesUnderLight(int decimals) : scene(EmptyScene()) {
    AddSquare(scene, {0, 0, 0}, 2, true);
    const PatchId light = AddSquare(scene, {0.5, 0.7, 3}, 0.4, false, 1);
    AddBox(scene, {-0.5, -0.4, 0}, {0.45, 0.4, 0.6}, false);
    AddBox(scene, {0.7, -0.9, 0.5}, {1.1, -0.3, 0.9}, true);
    scene.materials[1].emittance = Rgb(100, 90, 80);
    mesh_test::Tilt(scene, 20);
    if (decimals > 0) mesh_test::RoundCoordinates(scene, decimals);
    solution.forest = ElementForest(scene);
    for (int level = 0; level < 3; ++level)
      for (const ElementId leaf : solution.forest.AllLeaves()) solution.forest.Subdivide(leaf);
    solution.radiosity.assign(solution.forest.size(), Rgb::Zero());
    solution.irradiance.assign(solution.forest.size(), Rgb::Zero());
    for (const ElementId leaf : solution.forest.Leaves(light))
      solution.radiosity[static_cast<std::size_t>(leaf)] = scene.materials[1].emittance;
    visibility = PatchVisibility(scene);
    sources = SourceSet::Emitters(scene);
    exact = std::make_unique<PointIrradiance>(scene, visibility, sources);
  }

  MeshResult Run(const MeshOptions& options) const {
    return RunLocalPass(visibility, solution, Sampler(), options, ExecutionContext());
  }
  RepresentationError Measure(const MeshResult& result) const {
    const RepresentationError e = MeasureRepresentationError(scene, result.mesh, Sampler(), 4000, 1);
    const MeshReport::Counts& c = result.report.counts;
    std::printf(
        "max %.4f p99 %.4f p95 %.4f rms %.4f (worst on patch %d at %g %g %g), %zu triangles, %zu "
        "evaluations, "
        "%zu discontinuities, %zu activated, %zu refused, %zu contacts refused, %zu dropped\n",
        e.max, e.p99, e.p95, e.rms, e.worst_face, e.worst_point.x(), e.worst_point.y(), e.worst_point.z(),
        c.triangles, c.point_evaluations, c.discontinuities, c.activated, c.refused, c.refused_contacts,
        c.dropped_segments);
    return e;
  }
  IrradianceSampler Sampler() const {
    return [this](PatchId patch, const ReceiverPoint& at) { return exact->OnPatch(patch, at); };
  }

  Scene scene;
  RadiositySolution solution;
  PatchVisibility visibility;
  SourceSet sources;
  std::unique_ptr<PointIrradiance> exact;
};

MeshOptions UpTo20() {
  MeshOptions options;
  options.discontinuities.max_leaf_dsets = 20;
  return options;
}

// The discontinuity mesh shows the boxes' shadows better than the quadtree alone, and no light leaks in along
// the foot of the one that stands.
TEST(LocalPass, DiscontinuitiesPay) {
  const BoxesUnderLight boxes(0);
  const MeshResult with = boxes.Run(UpTo20());
  MeshOptions off = UpTo20();
  off.discontinuities.choice = "none";
  const RepresentationError fine = boxes.Measure(with), coarse = boxes.Measure(boxes.Run(off));
  EXPECT_EQ(with.report.counts.refused_contacts, 0U);
  EXPECT_LT(fine.rms, 0.25 * coarse.rms);
  EXPECT_LT(fine.p99, 0.25 * coarse.p99);
  EXPECT_LT(fine.max, 10);
}

// In files with six decimals things that touch are half a micrometre apart or within each other. They still
// touch.
TEST(LocalPass, RoundedCoordinatesStillTouch) {
  const BoxesUnderLight exact(0), rounded(6);
  const RepresentationError before = exact.Measure(exact.Run(UpTo20())),
                            after = rounded.Measure(rounded.Run(UpTo20()));
  EXPECT_LT(after.rms, 1.5 * before.rms);
  EXPECT_LT(after.p99, 1.5 * before.p99);
}

// The same bytes come out for one thread and many.
TEST(LocalPass, ThreadsDoNotMatter) {
  const BoxesUnderLight boxes(0);
  const MeshResult many = boxes.Run(UpTo20());
  SetThreadCount(1);
  const MeshResult one = boxes.Run(UpTo20());
  SetThreadCount(0);
  ASSERT_EQ(many.mesh.irradiance.size(), one.mesh.irradiance.size());
  for (std::size_t i = 0; i < many.mesh.irradiance.size(); ++i) {
    const QuadraticInterpolant &p = many.mesh.irradiance[i], &q = one.mesh.irradiance[i];
    EXPECT_TRUE((p.a == q.a).all() && (p.b2 == q.b2).all() && (p.c2 == q.c2).all() && (p.d == q.d).all() &&
                (p.e2 == q.e2).all() && (p.f == q.f).all());
  }
}

}  // namespace
}  // namespace penumbra
