#include "solver/geometry/region_difference.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "solver/base/size.h"
#include "solver/geometry/convex_clip.h"
#include "solver/geometry/convex_pieces.h"

namespace penumbra {
namespace {

// The outline's loop is 0, then come those of the cuts.
class Snapper {
 public:
  Snapper(std::span<const Vec2> outline, std::span<const Polygon2> cuts, const SnapTolerance& reach)
      : reach_(reach), window_(std::max(reach.base, reach.step.x())) {
    AddLoop(outline);
    for (const Polygon2& cut : cuts) AddLoop(cut);
  }

  void Snap() {
    SnapCorners();
    SnapToEdges();
  }

  const std::vector<Vec2>& points() const { return points_; }

  // The edges, bent where they pass a corner of another loop.
  std::vector<ConstraintSegment> Segments() const {
    std::vector<ConstraintSegment> segments;
    for (std::int32_t e = 0; e < Size(points_); ++e) {
      std::vector<std::pair<double, std::int32_t>> on = passed_[e];
      std::sort(on.begin(), on.end());
      std::int32_t from = e;
      const std::int32_t tag = loop_of_[e] == 0 ? kBorder : loop_of_[e] - 1;
      for (const auto& [at, via] : on) {
        segments.push_back({from, via, tag});
        from = via;
      }
      segments.push_back({from, next_[e], tag});
    }
    return segments;
  }

 private:
  void AddLoop(std::span<const Vec2> loop) {
    const std::int32_t first = Size(points_);
    for (std::int32_t i = 0; i < Size(loop); ++i) {
      points_.push_back(loop[i]);
      next_.push_back(first + (i + 1) % Size(loop));
      loop_of_.push_back(loops_);
    }
    ++loops_;
    passed_.resize(points_.size());
  }

  // Moves each corner of a cut onto the nearest of the corners before it that is in the same place.
  void SnapCorners() {
    std::multimap<double, std::int32_t> by_x;
    moved_.assign(points_.size(), 0);
    for (std::int32_t i = 0; i < Size(points_); ++i) {
      Vec2& p = points_[i];
      std::int32_t nearest = -1;
      double least = 0;
      for (auto other = by_x.lower_bound(p.x() - window_);
           loop_of_[i] > 0 && other != by_x.end() && other->first <= p.x() + window_; ++other) {
        const std::int32_t j = other->second;
        const double squared = (points_[j] - p).squaredNorm();
        if (!reach_.SamePlace(points_[j], p)) continue;
        if (nearest >= 0 && std::pair(squared, j) > std::pair(least, nearest)) continue;
        nearest = j;
        least = squared;
      }
      if (nearest >= 0) {
        p = points_[nearest];
        moved_[i] = 1;
      } else {
        by_x.emplace(p.x(), i);
      }
    }
  }

  // Moves corners onto the edges of earlier loops that they are near, and bends edges through the corners of
  // earlier loops.
  void SnapToEdges() {
    std::vector<std::int32_t> order;
    for (std::int32_t i = 0; i < Size(points_); ++i)
      if (!moved_[i]) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      return std::pair(points_[a].x(), a) < std::pair(points_[b].x(), b);
    });
    std::vector<double> xs;
    for (const std::int32_t i : order) xs.push_back(points_[i].x());
    const double reach = std::max(reach_.base, reach_.step.norm());
    for (std::int32_t e = 0; e < Size(points_); ++e) {
      const Vec2 a = points_[e], b = points_[next_[e]];
      const double low = std::min(a.x(), b.x()) - 2 * reach, high = std::max(a.x(), b.x()) + 2 * reach;
      auto k = static_cast<std::size_t>(std::lower_bound(xs.begin(), xs.end(), low) - xs.begin());
      for (; k < xs.size() && xs[k] <= high; ++k) Meet(e, order[k]);
    }
  }

  void Meet(std::int32_t e, std::int32_t corner) {
    if (loop_of_[e] == loop_of_[corner]) return;
    const Vec2 &a = points_[e], &b = points_[next_[e]], &p = points_[corner];
    const double length = (b - a).norm();
    if (!(length > 0)) return;
    const Vec2 along = (b - a) / length;
    const double at = along.dot(p - a), off = Cross2(along, p - a);
    if (off == 0 || at <= 0 || at >= length) return;
    if (std::abs(off) > reach_.Across({along.y(), -along.x()})) return;
    if (reach_.SamePlace(a, p) || reach_.SamePlace(b, p)) return;
    if (loop_of_[corner] < loop_of_[e]) {
      passed_[e].emplace_back(at, corner);
    } else if (!moved_[corner]) {
      points_[corner] = a + at * along;
      moved_[corner] = 1;
    }
  }

  SnapTolerance reach_;
  double window_;
  std::vector<Vec2> points_;
  std::vector<std::int32_t> next_;     // of each corner, the next of its loop: edge e runs from corner e
  std::vector<std::int32_t> loop_of_;  // of each corner
  std::vector<char> moved_;
  std::vector<std::vector<std::pair<double, std::int32_t>>> passed_;  // of each edge, corners and where
  std::int32_t loops_ = 0;
};

Polygon2 PolygonOf(const std::vector<Vec2>& vertices, std::span<const std::int32_t> corners) {
  Polygon2 polygon;
  for (const std::int32_t v : corners)
    if (v >= 0) polygon.push_back(vertices[v]);
  return polygon;
}

// Groups of triangles that hang together by their sides: of each triangle, one of its group.
std::vector<std::int32_t> Groups(std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<std::int32_t> group(triangles.size());
  std::iota(group.begin(), group.end(), 0);
  const auto find = [&](std::int32_t t) {
    while (group[t] != t) t = group[t] = group[group[t]];
    return t;
  };
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> side;
  for (std::int32_t t = 0; t < Size(triangles); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      const auto [other, added] = side.try_emplace(std::minmax(a, b), t);
      if (!added) group[find(t)] = find(other->second);
    }
  for (std::int32_t t = 0; t < Size(triangles); ++t) group[t] = find(t);
  return group;
}

// The narrower side of a rectangle with that area and that border; of the square where there is none.
double WidthOf(double area, double border) {
  const double half = 0.5 * border;
  const double root = half + std::sqrt(std::max(0.0, half * half - 4 * area));
  return root > 0 ? 2 * area / root : 0;
}

// Leaves out groups whose area and border are those of a strip no wider than the reach.
void DropStrips(RegionDifference& difference, const SnapTolerance& reach) {
  const std::vector<std::int32_t> group = Groups(difference.triangles);
  struct Measure {
    double area = 0, border = 0, longest = 0;
    Vec2 across = Vec2::UnitX();  // the longest side of the border
  };
  std::map<std::pair<std::int32_t, std::int32_t>, int> times;
  for (const auto& t : difference.triangles)
    for (int k = 0; k < 3; ++k) ++times[std::minmax(t[k], t[(k + 1) % 3])];
  std::vector<Measure> measures(group.size());
  for (std::size_t t = 0; t < group.size(); ++t) {
    Measure& measure = measures[group[t]];
    const auto& corner = difference.triangles[t];
    measure.area += SignedArea(PolygonOf(difference.vertices, corner));
    for (int k = 0; k < 3; ++k) {
      if (times[std::minmax(corner[k], corner[(k + 1) % 3])] > 1) continue;
      const Vec2 side = difference.vertices[corner[(k + 1) % 3]] - difference.vertices[corner[k]];
      const double length = side.norm();
      measure.border += length;
      if (length <= measure.longest) continue;
      measure.longest = length;
      measure.across = Vec2(side.y(), -side.x()) / length;
    }
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < group.size(); ++t) {
    const Measure& measure = measures[group[t]];
    if (WidthOf(measure.area, measure.border) > reach.Across(measure.across))
      difference.triangles[kept++] = difference.triangles[t];
  }
  difference.triangles.resize(kept);
}

}  // namespace

RegionDifference RegionSubtractor::Subtract(std::span<const Vec2> outline, std::span<const Polygon2> cuts,
                                            const SnapTolerance& reach) {
  Snapper snapper(outline, cuts, reach);
  snapper.Snap();
  const std::vector<ConstraintSegment> segments = snapper.Segments();
  const ConstrainedTriangulation* mesh = triangulator_.TryTriangulate(snapper.points(), segments);
  if (!mesh) return SubtractByClipping(outline, cuts, reach);
  std::vector<char> lost(mesh->triangles.size(), 0);
  for (std::int32_t cut = 0; cut < Size(cuts); ++cut) {
    const std::vector<std::int32_t> winding = WindingNumbers(*mesh, segments, cut);
    for (std::size_t t = 0; t < lost.size(); ++t)
      if (winding[t] > 0) lost[t] = 1;
  }
  RegionDifference difference{mesh->vertices, {}};
  for (std::size_t t = 0; t < lost.size(); ++t)
    if (mesh->triangles[t].winding > 0 && !lost[t]) difference.triangles.push_back(mesh->triangles[t].vertex);
  if (!cuts.empty()) DropStrips(difference, reach);
  return difference;
}

std::vector<Polygon2> RegionSubtractor::ConvexParts(std::span<const Vec2> outline) {
  if (outline.size() == 3 ||
      (outline.size() == 4 && QuadrilateralQuality(outline[0], outline[1], outline[2], outline[3]) > 0))
    return {Polygon2(outline.begin(), outline.end())};
  const RegionDifference whole = Subtract(outline, {}, {});
  std::vector<Polygon2> parts;
  for (const ConvexPiece& piece : JoinTriangles(whole.vertices, whole.triangles))
    parts.push_back(PolygonOf(whole.vertices, piece.vertex));
  return parts;
}

RegionDifference RegionSubtractor::SubtractByClipping(std::span<const Vec2> outline,
                                                      std::span<const Polygon2> cuts,
                                                      const SnapTolerance& reach) {
  RegionDifference difference;
  difference.vertices.assign(outline.begin(), outline.end());
  for (const Polygon2& cut : cuts)
    difference.vertices.insert(difference.vertices.end(), cut.begin(), cut.end());
  if (cuts.empty()) {
    // An outline that is not simple beside rounding: its fan, less what runs backwards.
    for (std::int32_t i = 2; i < Size(outline); ++i)
      if (SignedArea(std::array{outline[0], outline[i - 1], outline[i]}) > 0)
        difference.triangles.push_back({0, i - 1, i});
    return difference;
  }
  std::vector<Polygon2> parts = ConvexParts(outline);
  for (const Polygon2& cut : cuts)
    for (const Polygon2& hole : ConvexParts(cut)) {
      std::vector<Polygon2> left;
      for (const Polygon2& part : parts) SubtractConvex(part, hole, reach.base, left);
      parts = std::move(left);
    }
  for (const Polygon2& part : parts) {
    const Strip strip = NarrowestStrip(part);
    if (strip.width <= reach.Across(strip.across)) continue;
    const std::int32_t first = Size(difference.vertices);
    difference.vertices.insert(difference.vertices.end(), part.begin(), part.end());
    for (std::int32_t i = 2; i < Size(part); ++i)
      if (SignedArea(std::array{part[0], part[i - 1], part[i]}) > 0)
        difference.triangles.push_back({first, first + i - 1, first + i});
  }
  return difference;
}

}  // namespace penumbra
