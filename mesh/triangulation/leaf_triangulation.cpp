#include "mesh/triangulation/leaf_triangulation.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/discontinuities/leaf_lines.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

using VertexId = PatchBorders::VertexId;

// The result of a task for one leaf.
struct MadeLeaf {
  std::shared_ptr<const LeafMesh> mesh;
  std::vector<double> key;  // only with a cache, for a leaf with lines
  bool kept = false;        // found in the cache
};

// Triangulates one leaf after another. Each task has its own object.
class LeafMaker {
 public:
  LeafMaker(const ElementForest& forest, const PatchBorders& borders, const PatchDSets& dsets,
            const LeafMeshCache* cache)
      : forest_(forest), borders_(borders), dsets_(dsets), cache_(cache) {}

  MadeLeaf Make(std::size_t leaf) {
    borders_.Around(leaf, loop_);
    points_.clear();
    for (const VertexId v : loop_) points_.push_back(borders_.in_plane[v]);
    shape_.Reset(points_, LeafOutline(forest_[dsets_.leaves[leaf]], borders_.frame), borders_.snap);
    for (const std::int32_t line : dsets_.leaf_lines[leaf]) shape_.AddLine(dsets_.lines[line]);
    MadeLeaf made;
    if (cache_ && !shape_.lines().empty()) {
      shape_.Encode(&made.key);
      made.mesh = cache_->Find(made.key);
      made.kept = made.mesh != nullptr;
    }
    if (!made.mesh) made.mesh = std::make_shared<const LeafMesh>(triangulator_.Triangulate(shape_));
    return made;
  }

 private:
  const ElementForest& forest_;
  const PatchBorders& borders_;
  const PatchDSets& dsets_;
  const LeafMeshCache* cache_;
  std::vector<VertexId> loop_;
  std::vector<Vec2> points_;
  LeafShape shape_;
  LeafTriangulator triangulator_;
};

}  // namespace

PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets) {
  return TriangulateLeaves(forest, patch, dsets, PatchBorders(forest, patch, dsets));
}

PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets,
                                     PatchBorders borders, LeafMeshCache* cache) {
  std::vector<MadeLeaf> made(dsets.leaves.size());
  constexpr std::size_t kLeavesATask = 32;
  ParallelForChunks(made.size(), kLeavesATask, [&](std::size_t begin, std::size_t end) {
    LeafMaker maker(forest, borders, dsets, cache);
    for (std::size_t leaf = begin; leaf < end; ++leaf) made[leaf] = maker.Make(leaf);
  });

  PatchTriangulation result;
  result.patch = patch;
  result.leaves = dsets.leaves;
  result.positions = std::move(borders.positions);
  result.in_plane = std::move(borders.in_plane);
  std::size_t triangles = 0, inside = 0;
  for (const MadeLeaf& leaf : made) {
    triangles += leaf.mesh->triangles.size();
    inside += leaf.mesh->inside.size();
  }
  result.triangles.reserve(triangles);
  result.positions.reserve(result.positions.size() + inside);
  result.in_plane.reserve(result.in_plane.size() + inside);
  result.first_triangle.reserve(made.size() + 1);
  if (cache) cache->Clear();
  std::vector<VertexId> loop;
  for (std::size_t leaf = 0; leaf < made.size(); ++leaf) {
    const LeafMesh& mesh = *made[leaf].mesh;
    const std::vector<std::int32_t>& lines = dsets.leaf_lines[leaf];
    result.first_triangle.push_back(static_cast<std::uint32_t>(result.triangles.size()));
    result.dropped_segments += mesh.dropped_segments;
    if (!lines.empty()) ++(made[leaf].kept ? result.leaves_kept : result.leaves_made);
    borders.Around(leaf, loop);
    const auto base = static_cast<VertexId>(result.positions.size());
    for (const Vec2& p : mesh.inside) {
      result.in_plane.push_back(p);
      result.positions.push_back(borders.frame.FromPlane(p));
    }
    for (const LeafMesh::Triangle& t : mesh.triangles) {
      PatchTriangulation::Triangle& triangle = result.triangles.emplace_back();
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = t.vertex[k];
        triangle.vertex[k] = v < mesh.border_size ? loop[v] : base + (v - mesh.border_size);
        if (t.line[k] != kNoLine) triangle.line[k] = lines[t.line[k]];
      }
      triangle.contact = t.contact;
    }
    if (cache && !made[leaf].key.empty()) cache->Insert(std::move(made[leaf].key), made[leaf].mesh);
  }
  result.first_triangle.push_back(static_cast<std::uint32_t>(result.triangles.size()));
  PENUMBRA_DCHECK((result.Validate(forest.scene().patches[patch]), true));
  return result;
}

void PatchTriangulation::Validate(const Patch& outline) const {
  // Each triangle's area has an error of a few roundings of the patch's area; this bounds the error of the
  // sum. Edges bend by up to the snap distance to pass through vertices near them, which changes the area of
  // a narrow patch by more.
  constexpr double kAreaError = 1e-9;
  const double snap = SnapDistance(outline);
  double perimeter = 0;
  for (std::int32_t k = 0; k < outline.size; ++k)
    perimeter += (outline.vertex[k] - outline.vertex[(k + 1) % outline.size]).norm();
  std::map<std::pair<VertexId, VertexId>, std::size_t> directed;
  double area = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& v = triangles[i].vertex;
    const Vec2 &a = in_plane[v[0]], &b = in_plane[v[1]], &c = in_plane[v[2]];
    const double twice = Cross2(b - a, c - a);
    PENUMBRA_CHECK(twice > 0);
    area += 0.5 * twice;
    for (int k = 0; k < 3; ++k) PENUMBRA_CHECK(directed.try_emplace({v[k], v[(k + 1) % 3]}, i).second);
  }
  PENUMBRA_CHECK(std::abs(area - outline.area) <= kAreaError * outline.area + snap * perimeter);
  const Frame frame = PolygonFrame(outline.Vertices());
  for (const auto& [edge, triangle] : directed) {
    if (directed.contains({edge.second, edge.first})) continue;
    bool on_outline = false;
    for (std::int32_t k = 0; k < outline.size; ++k) {
      const Vec2 from = frame.ToPlane(outline.vertex[k]);
      const Vec2 side = (frame.ToPlane(outline.vertex[(k + 1) % outline.size]) - from).normalized();
      on_outline |= std::abs(Cross2(side, in_plane[edge.first] - from)) <= snap &&
                    std::abs(Cross2(side, in_plane[edge.second] - from)) <= snap;
    }
    PENUMBRA_CHECK(on_outline);
  }
}

}  // namespace penumbra
