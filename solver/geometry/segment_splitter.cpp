#include "solver/geometry/segment_splitter.h"

#include <CGAL/Exact_rational.h>
#include <CGAL/number_utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/base/size.h"
#include "solver/geometry/nearby_segments.h"
#include "solver/geometry/orientation.h"

namespace penumbra {
namespace {

// Where the lines ab and cd meet, rounded once.
Vec2 ExactCrossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  using Number = CGAL::Exact_rational;
  struct Exact {
    explicit Exact(const Vec2& p) : x(p.x()), y(p.y()) {}
    Number x, y;
  };
  const Exact from(a), to(b), other(c), end(d);
  const Number abx = to.x - from.x, aby = to.y - from.y, cdx = end.x - other.x, cdy = end.y - other.y;
  const Number t = ((other.x - from.x) * cdy - (other.y - from.y) * cdx) / (abx * cdy - aby * cdx);
  return {CGAL::to_double(Number(from.x + t * abx)), CGAL::to_double(Number(from.y + t * aby))};
}

// Where the segments ab and cd cross; a coordinate that a line holds constant is kept to the bit.
// REQUIRES: they do cross, by their orientations.
Vec2 Crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  // Below this sine of their angle rounding may move the crossing by more than kSnapDistance, along both.
  constexpr double kNearlyParallel = 1e-10;
  const Vec2 ab = b - a, cd = d - c;
  const double sine = Cross2(ab, cd);
  const bool sure = std::abs(sine) > kNearlyParallel * ab.norm() * cd.norm();
  Vec2 p = sure ? Vec2(a + ab * (Cross2(c - a, cd) / sine)) : ExactCrossing(a, b, c, d);
  // Beyond an end it would be no part of the segment.
  if (!sure)
    p = p.cwiseMax(a.cwiseMin(b)).cwiseMin(a.cwiseMax(b)).cwiseMax(c.cwiseMin(d)).cwiseMin(c.cwiseMax(d));
  for (int axis = 0; axis < 2; ++axis) {
    if (a[axis] == b[axis]) p[axis] = a[axis];
    if (c[axis] == d[axis]) p[axis] = c[axis];
  }
  return p;
}

// Where a point stands in the order along ab: its coordinate on the longer axis, free of rounding.
double Along(const Vec2& a, const Vec2& b, const Vec2& p) {
  const Vec2 ab = b - a;
  const int axis = std::abs(ab.x()) >= std::abs(ab.y()) ? 0 : 1;
  return ab[axis] >= 0 ? p[axis] : -p[axis];
}

// Whether boxes meet so many boxes of the tree that to look at all of them would take time by the square of
// their number: those of long slanted segments do. `box_of` returns the boxes 0 to count - 1.
template <class BoxOf>
bool IsCrowded(const BoxTree& tree, std::int32_t count, const BoxOf& box_of) {
  constexpr std::int32_t kAsked = 32;  // boxes, spread over all
  constexpr std::size_t kCrowd = 256;  // boxes that each may meet
  std::vector<std::int32_t> found;
  std::size_t met = 0, asked = 0;
  for (std::int32_t i = 0; i < count; i += std::max(1, count / kAsked), ++asked) {
    tree.Find(box_of(i), found);
    met += found.size();
  }
  return met > kCrowd * asked;
}

}  // namespace

bool SegmentSplitter::Split(std::vector<Vec2>& vertices, std::vector<bool>& used,
                            std::vector<SegmentPiece>& pieces, double snap) {
  vertices_ = &vertices;
  used_ = &used;
  pieces_ = &pieces;
  snap_ = snap;
  fresh_vertex_ = 0;
  fresh_.assign(pieces.size(), 1);
  double largest = 0;
  for (const Vec2& v : vertices) largest = std::max(largest, v.cwiseAbs().maxCoeff());
  rounding_ = 4 * std::numeric_limits<double>::epsilon() * largest;
  // Two or three turns do, unless vertices crowd within `snap` of each other: then snapping can go on for
  // ever, and only what meets exactly is joined. Even that can go on where crossings crowd within a rounding.
  constexpr int kSnappingTurns = 4, kMostTurns = 32;
  const std::size_t most = 4 * (vertices.size() + pieces.size() + pieces.size() * pieces.size());
  for (int turn = 0; turn < kMostTurns && vertices.size() + pieces.size() <= most; ++turn) {
    if (turn == kSnappingTurns) {
      snap_ = 0;
      fresh_.assign(pieces.size(), 1);
    }
    cuts_.clear();
    const std::int32_t known = Size(vertices);
    CutAtVertices();
    CutAtCrossings();
    fresh_vertex_ = known;
    if (!ApplyCuts()) return true;
  }
  return false;
}

// True if the vertex lies on the piece, or within snap_ of it and nearer to each end than they are to each
// other.
bool SegmentSplitter::Splits(const SegmentPiece& piece, std::int32_t vertex) const {
  if (vertex == piece.from || vertex == piece.to) return false;
  const Vec2& a = (*vertices_)[piece.from];
  const Vec2& b = (*vertices_)[piece.to];
  const Vec2& p = (*vertices_)[vertex];
  const Vec2 ab = b - a, ap = p - a;
  const double distance = std::abs(Cross2(ab, ap)) / ab.norm();
  if (distance > std::max(snap_, rounding_)) return false;
  const double at = Along(a, b, p);
  if (!(at > Along(a, b, a) && at < Along(a, b, b))) return false;
  if (Orientation(a, b, p) == 0) return true;
  const double squared = ab.squaredNorm();
  return distance <= snap_ && ap.squaredNorm() < squared && (b - p).squaredNorm() < squared;
}

void SegmentSplitter::Cut(std::int32_t piece, std::int32_t vertex) {
  const Vec2& a = (*vertices_)[(*pieces_)[piece].from];
  const Vec2& b = (*vertices_)[(*pieces_)[piece].to];
  cuts_.push_back({piece, Along(a, b, (*vertices_)[vertex]), vertex});
}

PlaneBox SegmentSplitter::BoxOf(const SegmentPiece& piece, double margin) const {
  const Vec2 &a = (*vertices_)[piece.from], &b = (*vertices_)[piece.to];
  return {a.cwiseMin(b).array() - margin, a.cwiseMax(b).array() + margin};
}

// From here on a tree is faster than a sweep, which takes time by the square of a comb's teeth.
bool SegmentSplitter::IsLarge() const {
  constexpr std::size_t kLarge = 512;
  return pieces_->size() >= kLarge;
}

// The same cuts as CutAtVertices() makes.
void SegmentSplitter::CutAtVerticesOfMany() {
  order_.clear();
  boxes_.clear();
  for (std::int32_t v = 0; v < Size(*vertices_); ++v)
    if ((*used_)[v]) {
      order_.push_back(v);
      boxes_.push_back({(*vertices_)[v], (*vertices_)[v]});
    }
  tree_.Build(boxes_);
  if (IsCrowded(tree_, Size(*pieces_), [&](std::int32_t i) { return BoxOf((*pieces_)[i], snap_); })) {
    const std::int32_t first_vertex = Size(*pieces_);
    std::vector<PlaneSegment> segments;
    for (const SegmentPiece& piece : *pieces_)
      segments.push_back({(*vertices_)[piece.from], (*vertices_)[piece.to]});
    for (const std::int32_t v : order_) segments.push_back({(*vertices_)[v], (*vertices_)[v]});
    if (const auto pairs = FindNearbyPairs(segments, std::max(snap_, rounding_))) {
      for (const auto& [i, k] : *pairs) {
        if (i >= first_vertex || k < first_vertex) continue;
        const std::int32_t v = order_[k - first_vertex];
        if ((fresh_[i] || v >= fresh_vertex_) && Splits((*pieces_)[i], v)) Cut(i, v);
      }
      return;
    }
  }
  for (std::int32_t i = 0; i < Size(*pieces_); ++i) {
    const SegmentPiece& piece = (*pieces_)[i];
    tree_.Find(BoxOf(piece, snap_), found_);
    for (const std::int32_t k : found_)
      if ((fresh_[i] || order_[k] >= fresh_vertex_) && Splits(piece, order_[k])) Cut(i, order_[k]);
  }
}

void SegmentSplitter::CutAtVertices() {
  if (IsLarge()) return CutAtVerticesOfMany();
  order_.clear();
  for (std::int32_t v = 0; v < Size(*vertices_); ++v)
    if ((*used_)[v]) order_.push_back(v);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    const double xa = (*vertices_)[a].x(), xb = (*vertices_)[b].x();
    return xa != xb ? xa < xb : a < b;
  });
  low_.resize(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) low_[k] = (*vertices_)[order_[k]].x();
  for (std::int32_t i = 0; i < Size(*pieces_); ++i) {
    const SegmentPiece& piece = (*pieces_)[i];
    const Vec2 low = (*vertices_)[piece.from].cwiseMin((*vertices_)[piece.to]).array() - snap_;
    const Vec2 high = (*vertices_)[piece.from].cwiseMax((*vertices_)[piece.to]).array() + snap_;
    auto k = static_cast<std::size_t>(std::lower_bound(low_.begin(), low_.end(), low.x()) - low_.begin());
    for (; k < low_.size() && low_[k] <= high.x(); ++k) {
      const std::int32_t v = order_[k];
      if (!fresh_[i] && v < fresh_vertex_) continue;
      const double y = (*vertices_)[v].y();
      if (y >= low.y() && y <= high.y() && Splits(piece, v)) Cut(i, v);
    }
  }
}

void SegmentSplitter::CutAtCrossings() {
  const auto left = [&](std::int32_t i) {
    const SegmentPiece& piece = (*pieces_)[i];
    return std::min((*vertices_)[piece.from].x(), (*vertices_)[piece.to].x());
  };
  order_.resize(pieces_->size());
  std::iota(order_.begin(), order_.end(), 0);
  left_.resize(pieces_->size());
  for (std::int32_t i = 0; i < Size(*pieces_); ++i) left_[i] = left(i);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    return left_[a] != left_[b] ? left_[a] < left_[b] : a < b;
  });
  if (IsLarge()) return CutAtCrossingsOfMany();
  low_.resize(order_.size());
  for (std::size_t k = 0; k < order_.size(); ++k) low_[k] = left_[order_[k]];
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const std::int32_t i = order_[k];
    const SegmentPiece& piece = (*pieces_)[i];
    const double right = std::max((*vertices_)[piece.from].x(), (*vertices_)[piece.to].x());
    for (std::size_t l = k + 1; l < order_.size() && low_[l] <= right; ++l) {
      const std::int32_t j = order_[l];
      if (fresh_[i] || fresh_[j]) CutCrossing(std::min(i, j), std::max(i, j));
    }
  }
}

// The same cuts as CutAtCrossings() makes, in the same order: new vertices are numbered by it.
void SegmentSplitter::CutAtCrossingsOfMany() {
  boxes_.clear();
  for (const std::int32_t i : order_) boxes_.push_back(BoxOf((*pieces_)[i], 0));
  tree_.Build(boxes_);
  if (IsCrowded(tree_, Size(boxes_), [&](std::int32_t k) { return boxes_[k]; })) {
    std::vector<PlaneSegment> segments;
    for (const std::int32_t i : order_)
      segments.push_back({(*vertices_)[(*pieces_)[i].from], (*vertices_)[(*pieces_)[i].to]});
    if (const auto pairs = FindNearbyPairs(segments, 0)) {
      for (const auto& [k, l] : *pairs)
        if (fresh_[order_[k]] || fresh_[order_[l]])
          CutCrossing(std::min(order_[k], order_[l]), std::max(order_[k], order_[l]));
      return;
    }
  }
  for (std::int32_t k = 0; k < Size(order_); ++k) {
    tree_.Find(boxes_[k], found_);
    std::sort(found_.begin(), found_.end());
    const std::int32_t i = order_[k];
    for (const std::int32_t l : found_)
      if (l > k && (fresh_[i] || fresh_[order_[l]]))
        CutCrossing(std::min(i, order_[l]), std::max(i, order_[l]));
  }
}

void SegmentSplitter::CutCrossing(std::int32_t i, std::int32_t j) {
  const SegmentPiece p = (*pieces_)[i], q = (*pieces_)[j];
  if (p.from == q.from || p.from == q.to || p.to == q.from || p.to == q.to) return;
  const Vec2 a = (*vertices_)[p.from], b = (*vertices_)[p.to];
  const Vec2 c = (*vertices_)[q.from], d = (*vertices_)[q.to];
  if (std::max(a.y(), b.y()) < std::min(c.y(), d.y()) || std::max(c.y(), d.y()) < std::min(a.y(), b.y()))
    return;
  if (Orientation(a, b, c) * Orientation(a, b, d) >= 0) return;
  if (Orientation(c, d, a) * Orientation(c, d, b) >= 0) return;
  // Where an end lies within the snap distance of the other piece, CutAtVertices has joined them there.
  if (Splits(p, q.from) || Splits(p, q.to) || Splits(q, p.from) || Splits(q, p.to)) return;
  const std::int32_t v = VertexNear(Crossing(a, b, c, d));
  if (v != p.from && v != p.to) Cut(i, v);
  if (v != q.from && v != q.to) Cut(j, v);
}

// The vertex nearest to p if it is within snap_, else p as a new one.
std::int32_t SegmentSplitter::VertexNear(const Vec2& p) {
  std::int32_t nearest = -1;
  double least = snap_ * snap_;
  for (std::int32_t v = 0; v < Size(*vertices_); ++v) {
    if (!(*used_)[v]) continue;
    const double squared = ((*vertices_)[v] - p).squaredNorm();
    if (squared > least || (squared == least && nearest >= 0)) continue;
    least = squared;
    nearest = v;
  }
  if (nearest >= 0) return nearest;
  vertices_->push_back(p);
  used_->push_back(true);
  return Size(*vertices_) - 1;
}

bool SegmentSplitter::ApplyCuts() {
  if (cuts_.empty()) return false;
  std::sort(cuts_.begin(), cuts_.end(), [](const CutPoint& a, const CutPoint& b) {
    if (a.piece != b.piece) return a.piece < b.piece;
    if (a.at != b.at) return a.at < b.at;
    return a.vertex < b.vertex;
  });
  next_.clear();
  next_fresh_.clear();
  std::size_t c = 0;
  for (std::int32_t i = 0; i < Size(*pieces_); ++i) {
    const SegmentPiece& piece = (*pieces_)[i];
    const char fresh = c < cuts_.size() && cuts_[c].piece == i;
    std::int32_t from = piece.from;
    for (; c < cuts_.size() && cuts_[c].piece == i; ++c) {
      if (cuts_[c].vertex == from) continue;
      next_.push_back({from, cuts_[c].vertex, piece.source});
      from = cuts_[c].vertex;
    }
    next_.push_back({from, piece.to, piece.source});
    next_fresh_.resize(next_.size(), fresh);
  }
  pieces_->swap(next_);
  fresh_.swap(next_fresh_);
  return true;
}

}  // namespace penumbra
