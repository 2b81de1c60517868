#include "mesh/leaf_triangulation.h"

#include <algorithm>
#include <map>
#include <utility>

#include "mesh/convex_triangulation.h"
#include "mesh/leaf_margins.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/segment_splitter.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

using VertexId = PatchBorders::VertexId;

// One leaf's triangles. Vertices from kInside on are its own.
struct LeafMesh {
  static constexpr VertexId kInside = VertexId{1} << 31;
  std::vector<Vec2> inside;
  std::vector<PatchTriangulation::Triangle> triangles;
  std::size_t dropped_segments = 0;
};

// Triangulates leaves one after the other. One object a thread.
class LeafTriangulator {
 public:
  LeafTriangulator(const ElementForest& forest, const PatchBorders& borders, const PatchDSets& dsets)
      : forest_(forest), borders_(borders), dsets_(dsets) {}

  LeafMesh Triangulate(std::size_t leaf) {
    borders_.Around(leaf, loop_);
    points_.clear();
    for (const VertexId v : loop_) points_.push_back(borders_.in_plane[v]);
    border_size_ = static_cast<std::int32_t>(points_.size());
    outline_ = LeafOutline(forest_[dsets_.leaves[leaf]], borders_.frame);
    segments_.clear();
    for (const std::int32_t line : dsets_.leaf_lines[leaf]) AddSegment(line);
    LeafMesh mesh;
    if (segments_.empty()) {
      TriangulateOutline(mesh);
    } else {
      TriangulateSegments(mesh);
    }
    for (const std::int32_t line : dsets_.leaf_lines[leaf]) MarkBorder(line, mesh);
    return mesh;
  }

 private:
  struct Segment {
    std::int32_t from, to, line;
  };

  // The DSet's edge within the leaf: the hull of its discontinuities there (thesis 5.5.7).
  void AddSegment(std::int32_t number) {
    const DiscontinuityLine& line = dsets_.lines[number];
    const LineInterval inner = ClipLine(line.origin, line.direction, outline_, kLeafMargin * borders_.snap);
    LineInterval hull = {0, 0},
                 reach = {0, 0};  // within the leaf; and as far as its outer discontinuities go
    bool any = false;
    for (const LineInterval& i : line.cover) {
      const LineInterval part = {std::max(i.t0, inner.t0), std::min(i.t1, inner.t1)};
      if (part.t0 > part.t1) continue;
      if (!any) {
        hull.t0 = part.t0;
        reach.t0 = i.t0;
      }
      any = true;
      hull.t1 = part.t1;
      reach.t1 = i.t1;
    }
    if (!any || hull.t1 - hull.t0 <= kLeafMargin * borders_.snap) return;
    const bool from_border = hull.t0 <= inner.t0 + Reach(), to_border = hull.t1 >= inner.t1 - Reach();
    std::int32_t from = from_border ? BorderVertexOn(line, reach.t0, hull.t0, true) : -1;
    std::int32_t to = to_border ? BorderVertexOn(line, hull.t1, reach.t1, false) : -1;
    if (from < 0) from = AddPoint(line.At(hull.t0));
    if (to < 0) to = AddPoint(line.At(hull.t1));
    // A contact that ends on the way gets a vertex, so that each edge jumps along its whole length or
    // nowhere.
    for (const LineInterval& i : line.contact)
      for (const double end : {i.t0, i.t1}) {
        if (end <= hull.t0 + borders_.snap || end >= hull.t1 - borders_.snap) continue;
        const std::int32_t next = AddPoint(line.At(end));
        PushSegment(from, next, number);
        from = next;
      }
    PushSegment(from, to, number);
  }

  void PushSegment(std::int32_t from, std::int32_t to, std::int32_t line) {
    if (from != to) segments_.push_back({from, to, line});
  }

  double Reach() const { return kLeafReach * borders_.snap; }

  // The border vertex on the line between t0 and t1, or within reach outside, that is next to the leaf's
  // inside: the last one if `last`, else the first; -1 if there is none.
  std::int32_t BorderVertexOn(const DiscontinuityLine& line, double t0, double t1, bool last) const {
    std::int32_t best = -1;
    double best_at = 0;
    const double before = last ? Reach() : borders_.snap, after = last ? borders_.snap : Reach();
    for (std::int32_t k = 0; k < border_size_; ++k) {
      if (std::abs(line.Distance(points_[k])) > kOnLine * borders_.snap) continue;
      const double at = line.Along(points_[k]);
      if (at < t0 - before || at > t1 + after) continue;
      if (best >= 0 && (last ? at <= best_at : at >= best_at)) continue;
      best = k;
      best_at = at;
    }
    return best;
  }

  // The end of a segment inside the leaf; ends within the snap distance of each other are one.
  std::int32_t AddPoint(const Vec2& p) {
    for (auto k = static_cast<std::size_t>(border_size_); k < points_.size(); ++k)
      if ((points_[k] - p).norm() <= borders_.snap) return static_cast<std::int32_t>(k);
    points_.push_back(p);
    return static_cast<std::int32_t>(points_.size()) - 1;
  }

  void TriangulateOutline(LeafMesh& mesh) {
    convex_.clear();
    TriangulateConvex(points_, convex_);
    for (const auto& t : convex_) {
      PatchTriangulation::Triangle triangle;
      for (int k = 0; k < 3; ++k) triangle.vertex[k] = loop_[t[k]];
      mesh.triangles.push_back(triangle);
    }
  }

  void TriangulateSegments(LeafMesh& mesh) {
    // A border that is split would leave a T-vertex: rather go without the weakest of the segments.
    while (!Split()) {
      const std::int32_t weakest = segments_.back().line;
      while (!segments_.empty() && segments_.back().line == weakest) segments_.pop_back();
      ++mesh.dropped_segments;
    }
    constraints_.clear();
    for (const SegmentPiece& p : pieces_)
      constraints_.push_back(
          {p.from, p.to, p.source < border_size_ ? kBorder : segments_[p.source - border_size_].line});
    const ConstrainedTriangulation& found = triangulator_.Triangulate(split_points_, constraints_);
    // What was split at the coarser snap distance does not meet again at the finer one.
    PENUMBRA_CHECK(found.vertices.size() == split_points_.size());
    mesh.inside.assign(found.vertices.begin() + border_size_, found.vertices.end());
    for (const ConstrainedTriangulation::Triangle& t : found.triangles) {
      if (!t.Inside()) continue;
      PatchTriangulation::Triangle triangle;
      for (int k = 0; k < 3; ++k) {
        const std::int32_t v = t.vertex[k];
        triangle.vertex[k] =
            v < border_size_ ? loop_[v] : LeafMesh::kInside + static_cast<VertexId>(v - border_size_);
        if (t.tag[k] < 0) continue;
        triangle.line[k] = t.tag[k];
        const Vec2 middle = 0.5 * (found.vertices[v] + found.vertices[t.vertex[(k + 1) % 3]]);
        for (const ConstrainedTriangulation::Cover& cover : found.Covers(found.edges[t.edge[k]])) {
          const std::int32_t tag = constraints_[cover.constraint].tag;
          if (tag >= 0 && IsContact(tag, middle)) triangle.contact[k] = true;
        }
      }
      mesh.triangles.push_back(triangle);
    }
  }

  // Splits border and segments where they meet; false if that would split or bend the border.
  bool Split() {
    split_points_ = points_;
    used_.assign(points_.size(), true);
    pieces_.clear();
    for (std::int32_t k = 0; k < border_size_; ++k) pieces_.push_back({k, (k + 1) % border_size_, k});
    for (std::size_t s = 0; s < segments_.size(); ++s)
      pieces_.push_back({segments_[s].from, segments_[s].to, border_size_ + static_cast<std::int32_t>(s)});
    // Points of a segment that was given up take no part.
    for (std::int32_t v = border_size_; v < static_cast<std::int32_t>(points_.size()); ++v)
      used_[v] = std::any_of(segments_.begin(), segments_.end(),
                             [&](const Segment& s) { return s.from == v || s.to == v; });
    if (segments_.empty()) return true;
    splitter_.Split(split_points_, used_, pieces_, borders_.snap);
    std::int32_t border_pieces = 0;
    for (const SegmentPiece& p : pieces_)
      if (p.source < border_size_) ++border_pieces;
    return border_pieces == border_size_;
  }

  bool IsContact(std::int32_t line, const Vec2& at) const {
    const DiscontinuityLine& l = dsets_.lines[line];
    return Covers(l.contact, l.Along(at), borders_.snap);
  }

  // Marks the border edges along the line. They need no segment.
  void MarkBorder(std::int32_t number, LeafMesh& mesh) const {
    const DiscontinuityLine& line = dsets_.lines[number];
    const auto on_line = [&](const Vec2& p) { return std::abs(line.Distance(p)) <= kOnLine * borders_.snap; };
    if (std::count_if(points_.begin(), points_.begin() + border_size_, on_line) < 2) return;
    for (PatchTriangulation::Triangle& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const VertexId v = t.vertex[k], w = t.vertex[(k + 1) % 3];
        if (v >= LeafMesh::kInside || w >= LeafMesh::kInside) continue;
        const Vec2 &a = borders_.in_plane[v], &b = borders_.in_plane[w];
        if (!on_line(a) || !on_line(b)) continue;
        const double middle = line.Along(0.5 * (a + b));
        if (!Covers(line.cover, middle, borders_.snap)) continue;
        if (t.line[k] == kNoLine) t.line[k] = number;
        if (Covers(line.contact, middle, borders_.snap)) t.contact[k] = true;
      }
  }

  const ElementForest& forest_;
  const PatchBorders& borders_;
  const PatchDSets& dsets_;
  std::vector<VertexId> loop_;  // the patch's ids of the first border_size_ points
  std::vector<Vec2> points_;    // around the border, then the ends of segments inside
  std::int32_t border_size_ = 0;
  Polygon2 outline_;
  std::vector<Segment> segments_;
  std::vector<Vec2> split_points_;
  std::vector<bool> used_;
  std::vector<SegmentPiece> pieces_;
  std::vector<ConstraintSegment> constraints_;
  std::vector<std::array<std::int32_t, 3>> convex_;
  SegmentSplitter splitter_;
  ConstrainedTriangulator triangulator_;
};

}  // namespace

PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets) {
  return TriangulateLeaves(forest, patch, dsets, PatchBorders(forest, patch, dsets));
}

PatchTriangulation TriangulateLeaves(const ElementForest& forest, PatchId patch, const PatchDSets& dsets,
                                     PatchBorders borders) {
  std::vector<LeafMesh> meshes(dsets.leaves.size());
  constexpr std::size_t kLeavesATask = 32;
  ParallelForChunks(meshes.size(), kLeavesATask, [&](std::size_t begin, std::size_t end) {
    LeafTriangulator triangulator(forest, borders, dsets);
    for (std::size_t leaf = begin; leaf < end; ++leaf) meshes[leaf] = triangulator.Triangulate(leaf);
  });

  PatchTriangulation result;
  result.patch = patch;
  result.leaves = dsets.leaves;
  result.positions = std::move(borders.positions);
  result.in_plane = std::move(borders.in_plane);
  for (const LeafMesh& mesh : meshes) {
    result.first_triangle.push_back(static_cast<std::uint32_t>(result.triangles.size()));
    result.dropped_segments += mesh.dropped_segments;
    const auto base = static_cast<VertexId>(result.positions.size());
    for (const Vec2& p : mesh.inside) {
      result.in_plane.push_back(p);
      result.positions.push_back(borders.frame.FromPlane(p));
    }
    for (PatchTriangulation::Triangle t : mesh.triangles) {
      for (VertexId& v : t.vertex)
        if (v >= LeafMesh::kInside) v = base + (v - LeafMesh::kInside);
      result.triangles.push_back(t);
    }
  }
  result.first_triangle.push_back(static_cast<std::uint32_t>(result.triangles.size()));
  PENUMBRA_DCHECK((result.Validate(forest.scene().patches[patch]), true));
  return result;
}

void PatchTriangulation::Validate(const Patch& outline) const {
  // The sum over triangles of areas whose error is some roundings of the patch's.
  constexpr double kAreaError = 1e-9;
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
  PENUMBRA_CHECK(std::abs(area - outline.area) <= kAreaError * outline.area);
  const Frame frame = PolygonFrame(outline.Vertices());
  const double snap = SnapDistance(outline);
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
