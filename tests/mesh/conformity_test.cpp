// That the mesh has no crack and no T-vertex: every scene that the program brings along, within patches and
// where patches meet in an edge.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "mesh_test_scenes.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

// An edge of a triangle with no other triangle of its patch beyond it.
struct RimEdge {
  PatchId patch;
  Vec3 a, b;
};

std::vector<RimEdge> Rim(const PatchTriangulation& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(t.vertex[k], t.vertex[(k + 1) % 3])];
  std::vector<RimEdge> rim;
  for (const auto& [edge, count] : uses) {
    EXPECT_LE(count, 2);
    if (count == 1) rim.push_back({mesh.patch, mesh.positions[edge.first], mesh.positions[edge.second]});
  }
  return rim;
}

struct Conformity {
  std::size_t edges = 0, rim = 0, shared = 0;
  std::size_t inner_t_vertices = 0;  // vertices of a patch on the inside of its own edges
  std::size_t cracks = 0;            // rim edges that run along another patch's without being one of its own
};

// Of a patch: vertices within the snap distance of an edge that they are no end of. Counted by place, not by
// number, so that it does not matter how the mesh was made.
void CountInside(const PatchTriangulation& mesh, double snap, Conformity& found) {
  std::vector<Vec2> used;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::set<std::uint32_t> vertices;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      edges.insert(std::minmax(t.vertex[k], t.vertex[(k + 1) % 3]));
      vertices.insert(t.vertex[k]);
    }
  used.reserve(vertices.size());
  for (const std::uint32_t v : vertices) used.push_back(mesh.in_plane[v]);
  std::sort(used.begin(), used.end(), [](const Vec2& p, const Vec2& q) { return p.x() < q.x(); });
  found.edges += edges.size();
  // What a segment within a leaf may bend by is the snap distance: a vertex that is nearer than a tenth of it
  // to an edge without being on it was overlooked.
  const double reach = 0.1 * snap;
  for (const auto& [v, w] : edges) {
    const Vec2 &a = mesh.in_plane[v], &b = mesh.in_plane[w];
    const auto first = std::lower_bound(used.begin(), used.end(), std::min(a.x(), b.x()) - reach,
                                        [](const Vec2& p, double x) { return p.x() < x; });
    for (auto p = first; p != used.end() && p->x() <= std::max(a.x(), b.x()) + reach; ++p) {
      if (*p == a || *p == b) continue;
      const double s = (*p - a).dot(b - a) / (b - a).squaredNorm();
      if (s > 0 && s < 1 && std::abs(Cross2(b - a, *p - a)) <= reach * (b - a).norm())
        ++found.inner_t_vertices;
    }
  }
}

// Across patches: where two rims run along each other, they have the same edges, to the bit.
void CountCracks(const Scene& scene, std::vector<RimEdge> rim, Conformity& found) {
  found.rim += rim.size();
  std::sort(rim.begin(), rim.end(), [](const RimEdge& e, const RimEdge& f) {
    return std::min(e.a.x(), e.b.x()) < std::min(f.a.x(), f.b.x());
  });
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const RimEdge& e = rim[i];
    const double snap_e = SnapDistance(scene.patches[e.patch]);
    const double right = std::max(e.a.x(), e.b.x());
    const Vec3 low = e.a.cwiseMin(e.b), high = e.a.cwiseMax(e.b);
    for (std::size_t j = i + 1; j < rim.size(); ++j) {
      const RimEdge& f = rim[j];
      const double snap = std::max(snap_e, SnapDistance(scene.patches[f.patch]));
      if (std::min(f.a.x(), f.b.x()) > right + snap) break;
      if (f.patch == e.patch) continue;
      if (((f.a.cwiseMin(f.b) - high).array() > snap).any() ||
          ((low - f.a.cwiseMax(f.b)).array() > snap).any())
        continue;
      // The shorter against the longer: both ends beside it, and more than an end in common.
      const bool e_longer = (e.b - e.a).norm() >= (f.b - f.a).norm();
      const Vec3 &a = e_longer ? e.a : f.a, &b = e_longer ? e.b : f.b, &p = e_longer ? f.a : e.a,
                 &q = e_longer ? f.b : e.b;
      const Vec3 along = (b - a).normalized();
      const auto off = [&](const Vec3& x) { return (x - a - along.dot(x - a) * along).norm(); };
      if (off(p) > snap || off(q) > snap) continue;
      const double t0 = std::min(along.dot(p - a), along.dot(q - a)),
                   t1 = std::max(along.dot(p - a), along.dot(q - a));
      if (t1 <= 2 * snap || t0 >= (b - a).norm() - 2 * snap) continue;
      const auto ends = [](const RimEdge& edge) {
        return std::minmax({mesh_test::PlaceOf(edge.a), mesh_test::PlaceOf(edge.b)});
      };
      if (ends(e) == ends(f))
        ++found.shared;
      else
        ++found.cracks;
    }
  }
}

Conformity Measure(const Scene& scene, std::span<const PatchTriangulation> meshes) {
  Conformity found;
  std::vector<RimEdge> rim;
  for (const PatchTriangulation& mesh : meshes) {
    mesh.Validate(scene.patches[mesh.patch]);
    CountInside(mesh, SnapDistance(scene.patches[mesh.patch]), found);
    const std::vector<RimEdge> edges = Rim(mesh);
    rim.insert(rim.end(), edges.begin(), edges.end());
  }
  CountCracks(scene, std::move(rim), found);
  return found;
}

class Conforming : public testing::TestWithParam<std::string> {};

// Every built-in scene, coarsely solved, with all discontinuities that matter as edges: as the solution's
// leaves are, and with leaves divided at random beside each other. No vertex lies on the inside of an edge,
// and where two patches share an edge, or part of one, they have the same edges there.
TEST_P(Conforming, HasNoCrackAndNoTVertex) {
  const std::optional<Scene> scene = LoadBuiltinScene(GetParam(), {});
  ASSERT_TRUE(scene.has_value());
  PipelineOptions options;
  options.error = 0.5;
  Pipeline pipeline(*scene, options);
  for (int i = 0; i < 2; ++i) pipeline.Iterate({});
  DiscontinuityOptions mesh = Resolve(*scene, PipelineOptions()).discontinuities;
  for (const bool divided : {false, true}) {
    ElementForest forest = pipeline.solution().forest;
    Random random(17);
    if (divided)
      for (PatchId p = 0; p < static_cast<PatchId>(scene->patches.size()); ++p)
        mesh_test::RefineAtRandom(forest, p, random, static_cast<int>(random.Index(9)), 4);
    MeshReport report;
    const std::vector<PatchTriangulation> meshes =
        PatchTriangulator(pipeline.visibility(), pipeline.solution(), mesh, {})
            .Triangulate({forest, {}}, report);
    const Conformity found = Measure(*scene, meshes);
    std::printf("%s: %zu triangles, %zu edges, %zu on rims, %zu shared\n", GetParam().c_str(),
                report.counts.triangles, found.edges, found.rim, found.shared);
    EXPECT_EQ(found.inner_t_vertices, 0U);
    EXPECT_EQ(found.cracks, 0U);
    EXPECT_GT(found.shared, 3U);
  }
}

std::vector<std::string> SceneNames() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : BuiltinScenes()) names.push_back(scene.name);
  return names;
}

std::string CaseName(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(BuiltinScenes, Conforming, testing::ValuesIn(SceneNames()), CaseName);

// The check itself finds what is wrong: a vertex left out on one side, and one that is moved by a little.
TEST(ConformingCheck, FindsCracks) {
  Scene scene = mesh_test::EmptyScene();
  mesh_test::AddPatch(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  mesh_test::AddPatch(scene, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}});
  ElementForest forest(scene);
  forest.Subdivide(ElementForest::Root(0));
  std::vector<PatchTriangulation> meshes;
  for (const PatchId p : {0, 1})
    meshes.push_back(TriangulateLeaves(forest, p, ActivateDiscontinuities(forest, p, {}, {})));
  EXPECT_EQ(Measure(scene, meshes).cracks, 2U) << "not welded";
  const ElementForest whole(scene);
  meshes[0] = TriangulateLeaves(whole, 0, ActivateDiscontinuities(whole, 0, {}, {}));
  EXPECT_EQ(Measure(scene, meshes).cracks, 0U);
  EXPECT_EQ(Measure(scene, meshes).shared, 1U);
  meshes[1].positions[0].y() += 1e-12;
  EXPECT_EQ(Measure(scene, meshes).cracks, 1U);
}

}  // namespace
}  // namespace penumbra
