#include "mesh/triangulation/leaf_triangulation.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <set>

#include "constraint_sets.h"
#include "mesh_test_scenes.h"
#include "solver/base/parallel.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

using mesh_test::AddPatch;
using mesh_test::EmptyScene;
using mesh_test::RefineAtRandom;
using mesh_test::Segment;

// The shapes of patches: a square, a general quadrilateral, a triangle, a long tilted rectangle far from the
// origin.
Scene PatchOfShape(int shape) {
  Scene scene = EmptyScene();
  switch (shape) {
    case 0:
      AddPatch(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
      break;
    case 1:
      AddPatch(scene, {{0, 0, 0}, {2, 0.1, 0}, {1.3, 1.1, 0}, {0.2, 0.9, 0}});
      break;
    case 2:
      AddPatch(scene, {{0, 0, 0}, {1, 0.2, 0.3}, {0.3, 1, 0.1}});
      break;
    default:
      AddPatch(scene, {{100, 200, 30}, {103, 200, 30}, {103, 200.3, 30.1}, {100, 200.3, 30.1}});
  }
  return scene;
}
constexpr int kShapes = 4;

struct Corpus {
  double worst_area = 0;
  std::size_t meshes = 0, triangles = 0, dropped = 0, wanted = 0;
};

void Check(const Scene& scene, const ElementForest& forest, const std::vector<Discontinuity>& found,
           int max_dsets, Corpus& corpus) {
  DiscontinuityOptions options;
  options.max_leaf_dsets = max_dsets;
  const PatchDSets dsets = ActivateDiscontinuities(forest, 0, found, options);
  const PatchTriangulation mesh = TriangulateLeaves(forest, 0, dsets);
  mesh.Validate(scene.patches[0]);
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> corner = {mesh.positions[t.vertex[0]], mesh.positions[t.vertex[1]],
                                        mesh.positions[t.vertex[2]]};
    area += VectorArea(corner).dot(scene.patches[0].normal);
  }
  corpus.worst_area = std::max(corpus.worst_area, std::abs(area / scene.patches[0].area - 1));
  ++corpus.meshes;
  corpus.triangles += mesh.triangles.size();
  corpus.dropped += mesh.dropped_segments;
  corpus.wanted += dsets.dsets_active;
}

// A point of the patch from two fractions in [0, 1], in its plane.
Vec2 PointAt(const Scene& scene, double s, double t) {
  const Patch& patch = scene.patches[0];
  const Frame frame = PolygonFrame(patch.Vertices());
  const auto at = [&](double x) { return static_cast<std::int32_t>(x * kLatticeSize); };
  if (patch.size == 3 && s + t > 1) {
    s = 1 - s;
    t = 1 - t;
  }
  return frame.ToPlane(LatticePosition(patch, {at(s), at(t)}));
}

// Random segments on random balanced quadtrees of every shape: the triangulation covers the patch, every
// triangle runs counter-clockwise, and no edge inside the patch has a T-vertex.
TEST(TriangulateLeaves, RandomSegmentsConform) {
  Corpus corpus;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Scene scene = PatchOfShape(static_cast<int>(seed % kShapes));
    ElementForest forest(scene);
    RefineAtRandom(forest, 0, random, static_cast<int>(random.Index(30)), 8);
    std::vector<Discontinuity> found;
    for (std::uint32_t i = random.Index(25); i > 0; --i) {
      const Vec2 a = PointAt(scene, random.Uniform(), random.Uniform());
      const Vec2 b = a + random.LogUniform(1e-7, 2) * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
      const Vec2 inside = PointAt(scene, random.Uniform(), random.Uniform());
      found.push_back(Segment(a, random.Uniform() < 0.5 ? b : inside, random.Uniform()));
    }
    Check(scene, forest, found, 1 + static_cast<int>(random.Index(12)), corpus);
  }
  std::printf("%zu meshes, %zu triangles, %zu edges of leaves wanted, %zu dropped, worst area error %.2g\n",
              corpus.meshes, corpus.triangles, corpus.wanted, corpus.dropped, corpus.worst_area);
  EXPECT_LT(corpus.worst_area, 1e-12);
}

// A point that is special on purpose: a lattice point of some level, moved by nothing or by a distance around
// the tolerances.
Vec2 SpecialPoint(const Scene& scene, Random& random) {
  const double cells = static_cast<double>(1 << random.Index(5));
  const auto fraction = [&] {
    return static_cast<double>(random.Index(static_cast<std::uint32_t>(cells) + 1)) / cells;
  };
  Vec2 p = PointAt(scene, fraction(), fraction());
  if (random.Uniform() < 0.5) {
    const double distance = random.LogUniform(1e-16, 1e-6);
    p += distance * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1));
  }
  return p;
}

// The same with degenerate input: ends on lattice points or within 1e-16 … 1e-6 of them, segments along
// quadtree lines, through corners, collinear, overlapping, repeated, ending on each other, parallel at tiny
// distances.
TEST(TriangulateLeaves, DegenerateSegmentsConform) {
  Corpus corpus;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed, 7);
    const Scene scene = PatchOfShape(static_cast<int>(seed % kShapes));
    ElementForest forest(scene);
    RefineAtRandom(forest, 0, random, static_cast<int>(random.Index(12)), 4);
    std::vector<Discontinuity> found;
    const auto degree = [&] {
      return random.Uniform() < 0.3 ? DiscontinuityDegree::kD0 : DiscontinuityDegree::kD2;
    };
    const auto add = [&](const Vec2& a, const Vec2& b) {
      if ((b - a).norm() > SnapDistance(scene.patches[0]))
        found.push_back(Segment(a, b, random.Uniform(), degree()));
    };
    for (std::uint32_t i = 1 + random.Index(10); i > 0; --i) {
      const Vec2 a = SpecialPoint(scene, random), b = SpecialPoint(scene, random);
      add(a, b);
      switch (random.Index(6)) {
        case 0: {  // a parallel at a tiny distance
          const Vec2 d = (b - a).norm() > 0 ? Vec2((b - a).normalized()) : Vec2::UnitX();
          const Vec2 shift = random.LogUniform(1e-14, 1e-6) * Vec2(-d.y(), d.x());
          add(a + shift, b + shift);
          break;
        }
        case 1:  // an overlapping collinear part
          add(a + random.Uniform() * (b - a), a + random.Uniform(0.5, 2) * (b - a));
          break;
        case 2:  // one that ends on it
          add(a + random.Uniform() * (b - a), SpecialPoint(scene, random));
          break;
        case 3:  // one that crosses at a tiny angle
          add(a, b + random.LogUniform(1e-14, 1e-6) * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1)));
          break;
        case 4:  // the same once more, reversed
          add(b, a);
          break;
        default:
          break;
      }
    }
    Check(scene, forest, found, 1 + static_cast<int>(random.Index(14)), corpus);
  }
  std::printf("%zu meshes, %zu triangles, %zu edges of leaves wanted, %zu dropped, worst area error %.2g\n",
              corpus.meshes, corpus.triangles, corpus.wanted, corpus.dropped, corpus.worst_area);
  EXPECT_LT(corpus.worst_area, 1e-9);
  EXPECT_LT(corpus.dropped, corpus.wanted / 100);
}

// A star of lines through one lattice corner, and an axis-aligned grid partly along quadtree lines, conform,
// and all their edges are there: the lengths marked as discontinuity add up to the lengths given.
TEST(TriangulateLeaves, StarsAndGridsAreCompleteAndConform) {
  const Scene scene = PatchOfShape(0);
  ElementForest forest(scene);
  Random random(3);
  RefineAtRandom(forest, 0, random, 12, 4);
  for (const bool star : {true, false}) {
    std::vector<Discontinuity> found;
    double length = 0;
    const auto add = [&](const Vec2& a, const Vec2& b) {
      found.push_back(Segment(a, b, 1));
      length += (b - a).norm();
    };
    if (star) {
      for (int i = 0; i < 12; ++i) {
        const double angle = i * M_PI / 12;
        const Vec2 d = 0.4 * Vec2(std::cos(angle), std::sin(angle));
        add(Vec2(0.5, 0.5) - d, Vec2(0.5, 0.5) + d);
      }
    } else {
      for (int i = 1; i < 10; ++i) {
        add({i * 0.1, 0.05}, {i * 0.1, 0.95});
        add({0.05, i * 0.1}, {0.95, i * 0.1});
      }
    }
    DiscontinuityOptions options;
    options.max_leaf_dsets = 30;
    const PatchDSets dsets = ActivateDiscontinuities(forest, 0, found, options);
    EXPECT_EQ(dsets.refused, 0U);
    const PatchTriangulation mesh = TriangulateLeaves(forest, 0, dsets);
    mesh.Validate(scene.patches[0]);
    double marked = 0;
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        if (t.line[k] != kNoLine)
          marked += 0.5 * (mesh.in_plane[t.vertex[(k + 1) % 3]] - mesh.in_plane[t.vertex[k]]).norm();
    EXPECT_NEAR(marked, length, 1e-6) << (star ? "star" : "grid");
  }
}

// The least angle over all triangles, in degrees, and the share of triangles below 5 degrees.
struct Quality {
  std::size_t triangles = 0, thin = 0;
  double least = 180;
  void Add(const PatchTriangulation& mesh) {
    for (const auto& t : mesh.triangles) {
      double angle = 180;
      for (int k = 0; k < 3; ++k) {
        const Vec2 &p = mesh.in_plane[t.vertex[k]], &q = mesh.in_plane[t.vertex[(k + 1) % 3]],
                   &r = mesh.in_plane[t.vertex[(k + 2) % 3]];
        angle = std::min(angle, std::atan2(Cross2(q - p, r - p), (q - p).dot(r - p)) * 180 / M_PI);
      }
      ++triangles;
      thin += angle < 5 ? 1 : 0;
      least = std::min(least, angle);
    }
  }
};

// Adds lines that are known to be hard, of one of six kinds.
void AddHardLines(int kind, std::uint64_t seed, Random& random, mesh_test::ConstraintSet& set) {
  const auto anywhere = [&] { return set.At(random.Uniform(), random.Uniform()); };
  const Vec2 centre = seed % 2 == 0 ? set.At(0.25, 0.25) : anywhere();
  const Vec2 a = anywhere(), b = anywhere();
  switch (kind) {
    case 0:  // a star
      for (int i = 0; i < 12; ++i) set.Add(centre, anywhere(), i % 3 == 0);
      break;
    case 1:  // parallels
      for (int i = 0; i < 10; ++i) {
        const Vec2 side = i * 1e-12 * Vec2(-(b - a).y(), (b - a).x()).normalized();
        set.Add(a + side, b + side, i % 4 == 0);
      }
      break;
    case 2:  // T-contacts on one segment
      set.Add(a, b, true);
      for (int i = 0; i < 10; ++i) set.Add(anywhere(), a + random.Uniform() * (b - a), i % 2 == 0);
      break;
    case 3:  // a grid, partly along quadtree lines
      for (int i = 1; i < 8; ++i) {
        set.Add(set.At(i / 16.0, 0.05), set.At(i / 16.0, 0.45));
        set.Add(set.At(0.05, i / 16.0), set.At(0.45, i / 16.0), i % 2 == 0);
      }
      break;
    case 4:  // overlapping collinear segments, and one across each
      for (int i = 0; i < 8; ++i) {
        const double t = random.Uniform(-0.2, 1);
        set.Add(a + t * (b - a), a + (t + random.Uniform(0.01, 0.5)) * (b - a), i % 2 == 0);
        set.Add(a + t * (b - a), anywhere());
      }
      break;
    default:  // crossings that nearly coincide
      for (int i = 0; i < 10; ++i) {
        const Vec2 through = centre + random.LogUniform(1e-14, 1e-6) * Vec2(random.Uniform(-1, 1), 1);
        const Vec2 p = anywhere();
        set.Add(p, through + 0.5 * (through - p));
      }
  }
}

// Sets that are known to be hard, in every shape of patch: stars through one point, bundles of parallels
// 1e-12 apart, T-contacts, axis-aligned grids, combs of overlapping collinear segments: each mesh is whole,
// and every line is a union of edges.
TEST(TriangulateLeaves, CorpusOfHardSetsIsWhole) {
  int sets = 0;
  Quality quality;
  std::size_t dropped = 0;
  for (std::uint32_t shape = 0; shape < 4; ++shape)
    for (int kind = 0; kind < 6; ++kind)
      for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SCOPED_TRACE(testing::Message() << shape << ", kind " << kind << ", seed " << seed);
        Random random(seed, static_cast<std::uint64_t>(kind));
        mesh_test::ConstraintSet set;
        set.AddShape(shape);
        RefineAtRandom(set.forest, 0, random, static_cast<int>(random.Index(6)), 3);
        set.max_leaf_dsets = 40;
        AddHardLines(kind, seed, random, set);
        const PatchTriangulation mesh = mesh_test::CheckSet(set);
        quality.Add(mesh);
        dropped += mesh.dropped_segments;
        ++sets;
      }
  std::printf(
      "%d sets, %zu triangles, %zu segments dropped; %zu triangles have an angle below 5 degrees, the "
      "least is %.2g\n",
      sets, quality.triangles, dropped, quality.thin, quality.least);
  EXPECT_GE(sets, 500);
}

// A thousand segments across a single leaf: the mesh is whole.
TEST(TriangulateLeaves, ThousandSegmentsInALeaf) {
  mesh_test::ConstraintSet set;
  set.AddShape(0);
  set.max_leaf_dsets = 1000;
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 a = set.At(random.Uniform(), random.Uniform());
    set.Add(a, a + 0.1 * Vec2(random.Uniform(-1, 1), random.Uniform(-1, 1)), i % 10 == 0);
  }
  DiscontinuityOptions options;
  options.max_leaf_dsets = 1000;
  const PatchDSets dsets = ActivateDiscontinuities(set.forest, 0, set.found, options);
  EXPECT_GT(dsets.dsets_active, 990U);
  const PatchTriangulation mesh = mesh_test::CheckSet(set);
  EXPECT_GT(mesh.triangles.size(), 2000U);
}

// A contact along a leaf's border adds no edge but marks the border as a jump, from both sides; a contact
// across a leaf marks its edges, and none beyond its ends.
TEST(TriangulateLeaves, ContactsMarkBothSides) {
  const Scene scene = PatchOfShape(0);
  ElementForest forest(scene);
  forest.Subdivide(0);
  const std::vector<Discontinuity> found = {
      Segment({0.5, 0.5}, {0.5, 1}, kInfiniteWeight, DiscontinuityDegree::kD0),
      Segment({0.1, 0.2}, {0.4, 0.3}, kInfiniteWeight, DiscontinuityDegree::kD0)};
  const PatchDSets dsets = ActivateDiscontinuities(forest, 0, found, {});
  EXPECT_EQ(dsets.dsets_active, 1U);
  const PatchTriangulation mesh = TriangulateLeaves(forest, 0, dsets);
  mesh.Validate(scene.patches[0]);
  int along_border = 0;
  double jump = 0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      if (!t.contact[k]) continue;
      const Vec2 a = mesh.in_plane[t.vertex[k]], b = mesh.in_plane[t.vertex[(k + 1) % 3]];
      jump += (b - a).norm();
      if (a.x() == 0.5 && b.x() == 0.5) ++along_border;
    }
  EXPECT_EQ(along_border, 2);
  EXPECT_NEAR(jump, 2 * (0.5 + std::hypot(0.3, 0.1)), 1e-12);
}

// Without discontinuities a balanced quadtree conforms, and each hanging vertex is a corner of its coarse
// neighbour's triangles (case A of the thesis's 3.6).
TEST(TriangulateLeaves, HangingVerticesAreUsed) {
  const Scene scene = PatchOfShape(0);
  ElementForest forest(scene);
  forest.Subdivide(forest.Subdivide(0));
  const PatchTriangulation mesh = TriangulateLeaves(forest, 0, ActivateDiscontinuities(forest, 0, {}, {}));
  mesh.Validate(scene.patches[0]);
  // Four quarters of two triangles each, two leaves with one hanging vertex each, and one without.
  EXPECT_EQ(mesh.triangles.size(), 4U * 2 + 2 * 3 + 2);
}

// The same input gives the same bytes, whatever the number of threads.
TEST(TriangulateLeaves, ThreadsDoNotMatter) {
  const Scene scene = PatchOfShape(1);
  ElementForest forest(scene);
  Random random(11);
  RefineAtRandom(forest, 0, random, 60, 6);
  std::vector<Discontinuity> found;
  for (int i = 0; i < 40; ++i)
    found.push_back(Segment(PointAt(scene, random.Uniform(), random.Uniform()),
                            PointAt(scene, random.Uniform(), random.Uniform()), random.Uniform()));
  const PatchDSets dsets = ActivateDiscontinuities(forest, 0, found, {});
  SetThreadCount(1);
  const PatchTriangulation one = TriangulateLeaves(forest, 0, dsets);
  SetThreadCount(0);
  const PatchTriangulation many = TriangulateLeaves(forest, 0, dsets);
  ASSERT_EQ(one.triangles.size(), many.triangles.size());
  ASSERT_EQ(one.positions.size(), many.positions.size());
  for (std::size_t i = 0; i < one.triangles.size(); ++i)
    EXPECT_EQ(one.triangles[i].vertex, many.triangles[i].vertex);
  for (std::size_t i = 0; i < one.positions.size(); ++i) EXPECT_EQ(one.positions[i], many.positions[i]);
}

}  // namespace
}  // namespace penumbra
