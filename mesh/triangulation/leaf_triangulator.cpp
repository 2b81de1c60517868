#include "mesh/triangulation/leaf_triangulator.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "mesh/discontinuities/leaf_margins.h"
#include "mesh/triangulation/convex_triangulation.h"
#include "solver/base/check.h"

namespace penumbra {

void LeafShape::Reset(std::span<const Vec2> border, Polygon2 outline, double snap) {
  border_.assign(border.begin(), border.end());
  outline_ = std::move(outline);
  snap_ = snap;
  lines_.clear();
  intervals_.clear();
}

void LeafShape::AddLine(const DiscontinuityLine& line) {
  // The clipped line contains every border vertex that counts as lying on the line.
  const LineInterval near = ClipLine(line.origin, line.direction, outline_, -2 * kLeafReach * snap_);
  const auto cut = [&](std::span<const LineInterval> intervals) {
    for (const LineInterval& i : intervals) {
      const LineInterval part = {std::max(i.t0, near.t0), std::min(i.t1, near.t1)};
      if (part.t0 <= part.t1) intervals_.push_back(part);
    }
  };
  Line& added = lines_.emplace_back(Line{line, intervals_.size(), 0, 0});
  cut(line.cover);
  added.first_contact = intervals_.size();
  cut(line.contact);
  added.end = intervals_.size();
}

void LeafShape::Encode(std::vector<double>* key) const {
  key->clear();
  const auto add = [key](const Vec2& p) {
    key->push_back(p.x());
    key->push_back(p.y());
  };
  key->push_back(static_cast<double>(border_.size()));
  for (const Vec2& p : border_) add(p);
  for (const Vec2& p : outline_) add(p);
  for (const Line& line : lines_) {
    add(line.origin);
    add(line.direction);
    key->push_back(static_cast<double>(line.first_contact - line.first));
    key->push_back(static_cast<double>(line.end - line.first_contact));
  }
  for (const LineInterval& i : intervals_) {
    key->push_back(i.t0);
    key->push_back(i.t1);
  }
}

LeafMesh LeafTriangulator::Triangulate(const LeafShape& shape) {
  shape_ = &shape;
  points_.assign(shape.border().begin(), shape.border().end());
  border_size_ = static_cast<std::int32_t>(points_.size());
  segments_.clear();
  const auto lines = static_cast<std::int32_t>(shape.lines().size());
  for (std::int32_t line = 0; line < lines; ++line) AddSegment(line);
  LeafMesh mesh;
  mesh.border_size = static_cast<std::uint32_t>(border_size_);
  if (segments_.empty()) {
    TriangulateOutline(mesh);
  } else {
    TriangulateSegments(mesh);
  }
  for (std::int32_t line = 0; line < lines; ++line) MarkBorder(line, mesh);
  return mesh;
}

double LeafTriangulator::Reach() const { return kLeafReach * shape_->snap(); }

// Adds the DSet's edge within the leaf: the hull of its discontinuities there (thesis 5.5.7).
void LeafTriangulator::AddSegment(std::int32_t number) {
  const Line& line = shape_->lines()[number];
  const double snap = shape_->snap();
  const LineInterval inner = ClipLine(line.origin, line.direction, shape_->outline(), kLeafMargin * snap);
  LineInterval hull = {0, 0}, reach = {0, 0};  // within the leaf; to the ends of the outer discontinuities
  bool any = false;
  for (const LineInterval& i : shape_->Cover(line)) {
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
  if (!any || hull.t1 - hull.t0 <= kLeafMargin * snap) return;
  const bool from_border = hull.t0 <= inner.t0 + Reach(), to_border = hull.t1 >= inner.t1 - Reach();
  std::int32_t from = from_border ? BorderVertexOn(line, reach.t0, hull.t0, true) : -1;
  std::int32_t to = to_border ? BorderVertexOn(line, hull.t1, reach.t1, false) : -1;
  if (from < 0) from = AddPoint(line.At(hull.t0));
  if (to < 0) to = AddPoint(line.At(hull.t1));
  // A contact that ends on the way gets a vertex, so that the irradiance jumps along a whole edge or nowhere
  // on it.
  for (const LineInterval& i : shape_->Contact(line))
    for (const double end : {i.t0, i.t1}) {
      if (end <= hull.t0 + snap || end >= hull.t1 - snap) continue;
      const std::int32_t next = AddPoint(line.At(end));
      PushSegment(from, next, number);
      from = next;
    }
  PushSegment(from, to, number);
}

void LeafTriangulator::PushSegment(std::int32_t from, std::int32_t to, std::int32_t line) {
  if (from != to) segments_.push_back({from, to, line});
}

// The border vertex on the line between t0 and t1, or within reach outside, that is closest to the leaf's
// interior: the last vertex if `last`, otherwise the first; -1 if there is none.
std::int32_t LeafTriangulator::BorderVertexOn(const Line& line, double t0, double t1, bool last) const {
  std::int32_t best = -1;
  double best_at = 0;
  const double snap = shape_->snap();
  const double before = last ? Reach() : snap, after = last ? snap : Reach();
  for (std::int32_t k = 0; k < border_size_; ++k) {
    if (std::abs(line.Distance(points_[k])) > kOnLine * snap) continue;
    const double at = line.Along(points_[k]);
    if (at < t0 - before || at > t1 + after) continue;
    if (best >= 0 && (last ? at <= best_at : at >= best_at)) continue;
    best = k;
    best_at = at;
  }
  return best;
}

// Adds the end of a segment inside the leaf. Ends within the snap distance of each other become one point.
std::int32_t LeafTriangulator::AddPoint(const Vec2& p) {
  for (auto k = static_cast<std::size_t>(border_size_); k < points_.size(); ++k)
    if ((points_[k] - p).norm() <= shape_->snap()) return static_cast<std::int32_t>(k);
  points_.push_back(p);
  return static_cast<std::int32_t>(points_.size()) - 1;
}

void LeafTriangulator::TriangulateOutline(LeafMesh& mesh) {
  convex_.clear();
  TriangulateConvex(points_, convex_);
  mesh.triangles.reserve(convex_.size());
  for (const auto& t : convex_) {
    LeafMesh::Triangle triangle;
    for (int k = 0; k < 3; ++k) triangle.vertex[k] = static_cast<std::uint32_t>(t[k]);
    mesh.triangles.push_back(triangle);
  }
}

void LeafTriangulator::TriangulateSegments(LeafMesh& mesh) {
  // A split border would cause a T-vertex. The weakest segments are omitted instead.
  while (!Split()) {
    const std::int32_t weakest = segments_.back().line;
    while (!segments_.empty() && segments_.back().line == weakest) segments_.pop_back();
    ++mesh.dropped_segments;
  }
  constraints_.clear();
  for (std::int32_t k = 0; k < border_size_; ++k)
    constraints_.push_back({k, (k + 1) % border_size_, kBorder});
  for (const Segment& s : segments_) constraints_.push_back({s.from, s.to, s.line});
  const ConstrainedTriangulation& found =
      triangulator_.TriangulatePieces(split_points_, used_, pieces_, constraints_);
  mesh.inside.assign(found.vertices.begin() + border_size_, found.vertices.end());
  mesh.triangles.reserve(found.triangles.size());
  for (const ConstrainedTriangulation::Triangle& t : found.triangles) {
    if (!t.Inside()) continue;
    LeafMesh::Triangle triangle;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t v = t.vertex[k];
      triangle.vertex[k] = static_cast<std::uint32_t>(v);
      if (t.tag[k] < 0) continue;
      triangle.line[k] = t.tag[k];
      const Vec2 middle = 0.5 * (found.vertices[v] + found.vertices[t.vertex[(k + 1) % 3]]);
      for (const ConstrainedTriangulation::Cover& cover : found.Covers(found.edges[t.edge[k]])) {
        const std::int32_t tag = constraints_[cover.constraint].tag;
        if (tag < 0) continue;
        const Line& line = shape_->lines()[tag];
        if (Covers(shape_->Contact(line), line.Along(middle), shape_->snap())) triangle.contact[k] = true;
      }
    }
    mesh.triangles.push_back(triangle);
  }
}

// Splits border and segments at their intersections. Returns false if that would split or bend the border.
bool LeafTriangulator::Split() {
  split_points_ = points_;
  pieces_.clear();
  for (std::int32_t k = 0; k < border_size_; ++k) pieces_.push_back({k, (k + 1) % border_size_, k});
  used_.assign(points_.size(), false);
  std::fill(used_.begin(), used_.begin() + border_size_, true);
  // Points of omitted segments do not take part.
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    const Segment& segment = segments_[s];
    pieces_.push_back({segment.from, segment.to, border_size_ + static_cast<std::int32_t>(s)});
    used_[segment.from] = used_[segment.to] = true;
  }
  if (segments_.empty()) return true;
  if (!splitter_.Split(split_points_, used_, pieces_, shape_->snap())) return false;
  std::int32_t border_pieces = 0;
  for (const SegmentPiece& p : pieces_)
    if (p.source < border_size_) ++border_pieces;
  return border_pieces == border_size_;
}

// Marks the border edges along the line. Such edges need no segment.
void LeafTriangulator::MarkBorder(std::int32_t number, LeafMesh& mesh) const {
  const Line& line = shape_->lines()[number];
  const double snap = shape_->snap();
  const auto on_line = [&](const Vec2& p) { return std::abs(line.Distance(p)) <= kOnLine * snap; };
  if (std::count_if(points_.begin(), points_.begin() + border_size_, on_line) < 2) return;
  for (LeafMesh::Triangle& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = t.vertex[k], w = t.vertex[(k + 1) % 3];
      if (v >= mesh.border_size || w >= mesh.border_size) continue;
      const Vec2 &a = points_[v], &b = points_[w];
      if (!on_line(a) || !on_line(b)) continue;
      const double middle = line.Along(0.5 * (a + b));
      if (!Covers(shape_->Cover(line), middle, snap)) continue;
      if (t.line[k] == kNoLine) t.line[k] = number;
      if (Covers(shape_->Contact(line), middle, snap)) t.contact[k] = true;
    }
}

std::size_t LeafMeshCache::Hash::operator()(const std::vector<double>& key) const {
  std::uint64_t h = key.size();
  for (const double x : key) {
    h ^= std::bit_cast<std::uint64_t>(x + 0.0);  // equal bits for both zeros
    h *= 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29;
  }
  return h;
}

std::shared_ptr<const LeafMesh> LeafMeshCache::Find(const std::vector<double>& key) const {
  const auto found = meshes_.find(key);
  return found == meshes_.end() ? nullptr : found->second;
}

}  // namespace penumbra
