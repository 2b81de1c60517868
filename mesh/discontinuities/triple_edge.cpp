#include "mesh/discontinuities/triple_edge.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/base/check.h"
#include "solver/geometry/polygon.h"
#include "solver/geometry/segment_clip.h"
#include "solver/visibility/pair/tube.h"

namespace penumbra {
namespace {

using EdgeEnds = std::array<Vec3, 2>;

// A part of the first edge, whose ends are 0 and 1.
struct Range {
  double t0, t1;
};

// The limit on halvings of a piece. Only rounding errors prevent a piece from becoming straight earlier.
constexpr int kMostHalvings = 24;

// Parameters of an edge closer than this are equal: the root of an edge that two patches share.
constexpr double kSameRoot = 1e-12;

// True if the edges lie in one plane: compares six times the volume of the tetrahedron of their ends with
// rounding.
bool LieInOnePlane(const EdgeEnds& e, const EdgeEnds& f, double rounding) {
  const Vec3 d = e[1] - e[0], g = f[1] - f[0], across = d.cross(g);
  const double area = across.norm();
  // Parallel: the sine of the angle times the length of the shorter edge is within rounding.
  if (area * std::min(d.norm(), g.norm()) <= rounding * d.norm() * g.norm()) return true;
  return std::abs(across.dot(f[0] - e[0])) <= rounding * area;
}

// The point of the edge in the plane through p with this normal.
Vec3 OnPlane(const EdgeEnds& edge, const Vec3& p, const Vec3& normal) {
  const double f0 = normal.dot(edge[0] - p), f1 = normal.dot(edge[1] - p);
  return Between(edge[0], edge[1], std::clamp(f0 / (f0 - f1), 0.0, 1.0));
}

// The lines through three edges, parameterised by their points on the first edge.
class RuledSurface {
 public:
  RuledSurface(const EdgeEnds& first, const EdgeEnds& second, const EdgeEnds& third)
      : edge_{&first, &second, &third} {}

  // The parameters of the first edge whose line meets the second and third edge between their ends:
  // ascending, disjoint. The bounds are roots of linear functions.
  struct Ranges {
    std::array<Range, 3> range;  // of at most five parts, no two of which are adjacent
    int size = 0;
  };
  Ranges Domain() const;

  Vec3 Point(double t) const { return Between((*edge_[0])[0], (*edge_[0])[1], t); }
  // The direction of the line, quadratic in t.
  Vec3 Direction(const Vec3& p) const { return PlaneWith(1, p).cross(PlaneWith(2, p)); }
  std::array<Vec3, 3> Touched(double t) const {
    const Vec3 p = Point(t);
    return {p, OnPlane(*edge_[1], p, PlaneWith(2, p)), OnPlane(*edge_[2], p, PlaneWith(1, p))};
  }

 private:
  Vec3 PlaneWith(int i, const Vec3& p) const { return ((*edge_[i])[0] - p).cross((*edge_[i])[1] - p); }

  std::array<const EdgeEnds*, 3> edge_;
};

RuledSurface::Ranges RuledSurface::Domain() const {
  // The line meets the second edge if the edge's ends lie on different sides of the plane through p and the
  // third edge, where p is the line's point on the first edge; likewise with the second and third edge
  // exchanged. Each side is linear in p.
  std::array<std::array<double, 2>, 4> value;  // at both ends of the first edge
  for (int i = 0; i < 2; ++i) {
    for (int end = 0; end < 2; ++end) {
      const Vec3& p = (*edge_[0])[end];
      const Vec3 plane = PlaneWith(2 - i, p);
      for (int k = 0; k < 2; ++k) value[2 * i + k][end] = plane.dot((*edge_[1 + i])[k] - p);
    }
    const auto &a = value[2 * i], &b = value[2 * i + 1];
    if (std::min({a[0], a[1], b[0], b[1]}) >= 0 || std::max({a[0], a[1], b[0], b[1]}) <= 0) return {};
  }
  std::array<double, 6> cut = {0, 1, 1, 1, 1, 1};
  for (int f = 0; f < 4; ++f) {
    const auto& [a, b] = value[f];
    if (a * b < 0) cut[2 + f] = a / (a - b);
  }
  std::sort(cut.begin(), cut.end());
  Ranges domain;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    if (!(cut[i] < cut[i + 1])) continue;
    const double t = 0.5 * (cut[i] + cut[i + 1]);
    const auto at = [&](int f) { return (1 - t) * value[f][0] + t * value[f][1]; };
    if (at(0) * at(1) >= 0 || at(2) * at(3) >= 0) continue;
    if (domain.size > 0 && domain.range[domain.size - 1].t1 == cut[i])
      domain.range[domain.size - 1].t1 = cut[i + 1];
    else
      domain.range[domain.size++] = {cut[i], cut[i + 1]};
  }
  return domain;
}

// An edge of the source, or a blocker's edge; an edge of two faces occurs once.
struct EventEdge {
  bool of_source;
  std::int32_t number;  // Silhouettes::EdgeAt()
  PatchEdge at;
  EdgeEnds whole, ends;                 // the whole edge, and its part in the tube
  std::array<double, 2> above, before;  // heights of ends above the receiver and before the source [m]
};

// The part of a blocker between receiver and source.
struct Obstacle {
  PatchId patch;
  Vec3 normal;
  Polygon3 polygon;
};

// Finds the traces for one receiver and source.
class Tracer {
 public:
  Tracer(const Scene& scene, const Silhouettes& silhouettes, PatchId receiver, PatchId source,
         const TripleEdgeOptions& options)
      : scene_(scene),
        silhouettes_(silhouettes),
        receiver_(scene.patches[receiver]),
        source_id_(source),
        source_(scene.patches[source]),
        options_(options),
        tolerance_(std::max(options.tolerance, options.rounding)),
        lit_(ClipToHalfSpace(receiver_.Vertices(), source_.normal, source_.vertex[0])),
        lighting_(ClipToHalfSpace(source_.Vertices(), receiver_.normal, receiver_.vertex[0])) {}

  std::vector<TripleEdgeTrace> Trace(std::span<const PatchId> blockers) {
    if (lit_.empty() || lighting_.empty()) return {};
    CollectEdges(blockers);
    if (!options_.keep_hidden) CollectObstacles(blockers);
    // Three edges have a common line only if each pair of them has one.
    const std::size_t n = edges_.size();
    std::vector<std::vector<std::size_t>> partners(n);  // partners with higher indices
    std::vector<char> meet(n * n, 0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if (MayMeet(edges_[i], edges_[j])) {
          partners[i].push_back(j);
          meet[i * n + j] = 1;
        }
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t j : partners[i])
        for (const std::size_t k : partners[j])
          if (meet[i * n + k]) TraceTriple({&edges_[i], &edges_[j], &edges_[k]});
    return std::move(traces_);
  }

 private:
  double Above(const Vec3& p) const { return receiver_.normal.dot(p - receiver_.vertex[0]); }
  double Before(const Vec3& p) const { return source_.normal.dot(p - source_.vertex[0]); }

  // Collects the parts of edges that light from the source to the receiver can touch.
  void CollectEdges(std::span<const PatchId> blockers) {
    const ConvexRegion tube = Tube(lit_, lighting_).Region();
    const auto add = [&](PatchId patch, std::int32_t k, bool of_source) {
      const Patch& on = scene_.patches[patch];
      const std::int32_t number = silhouettes_.EdgeAt(patch, k);
      const EdgeEnds whole = {on.vertex[k], on.vertex[(k + 1) % on.size]};
      if (!of_source &&
          !(silhouettes_.MayBeSilhouette(number, lit_) && silhouettes_.MayBeSilhouette(number, lighting_)))
        return;
      SegmentClip clip;
      for (const HalfSpace& side : tube)
        clip.Keep(side.normal.dot(whole[0]) - side.offset + options_.rounding,
                  side.normal.dot(whole[1]) - side.offset + options_.rounding);
      clip.Keep(Above(whole[0]) - options_.gap, Above(whole[1]) - options_.gap);
      if (!of_source) clip.Keep(Before(whole[0]) - options_.rounding, Before(whole[1]) - options_.rounding);
      if (clip.Empty()) return;
      const EdgeEnds ends = {Between(whole[0], whole[1], clip.t0), Between(whole[0], whole[1], clip.t1)};
      edges_.push_back({of_source,
                        number,
                        {patch, k},
                        whole,
                        ends,
                        {Above(ends[0]), Above(ends[1])},
                        {Before(ends[0]), Before(ends[1])}});
    };
    for (std::int32_t k = 0; k < source_.size; ++k) add(source_id_, k, true);
    const auto of_source = static_cast<std::ptrdiff_t>(edges_.size());
    for (const PatchId blocker : blockers)
      for (std::int32_t k = 0; k < scene_.patches[blocker].size; ++k) add(blocker, k, false);
    const auto first = edges_.begin() + of_source;
    std::stable_sort(first, edges_.end(),
                     [](const EventEdge& e, const EventEdge& f) { return e.number < f.number; });
    edges_.erase(std::unique(first, edges_.end(),
                             [](const EventEdge& e, const EventEdge& f) { return e.number == f.number; }),
                 edges_.end());
  }

  void CollectObstacles(std::span<const PatchId> blockers) {
    for (const PatchId blocker : blockers) {
      const Patch& patch = scene_.patches[blocker];
      const Polygon3 above = ClipToHalfSpace(patch.Vertices(), receiver_.normal, receiver_.vertex[0]);
      if (above.empty()) continue;
      // A blocker flush with the source hides no part of the source.
      const Polygon3 between =
          ClipToHalfSpace(above, source_.normal, source_.vertex[0] + options_.rounding * source_.normal);
      if (!between.empty()) obstacles_.push_back({blocker, patch.normal, between});
    }
  }

  // False only if no line from receiver to source meets both edges, or if such lines cause no EEE events.
  bool MayMeet(const EventEdge& e, const EventEdge& f) const {
    if (e.of_source && f.of_source) return false;
    if (!e.of_source && !f.of_source && OfOneBody(e, f)) return false;
    if (LieInOnePlane(e.whole, f.whole, options_.rounding)) return false;
    // Whether one edge is closer to the receiver, or farther from the source, with all its points.
    const int nearer = WhollyLess(e.above, f.above), farther = WhollyLess(f.before, e.before);
    if (nearer * farther < 0) return false;
    if (nearer != 0 && !MayReach(e.ends, e.above, f.ends, f.above, lit_, receiver_.normal)) return false;
    return farther == 0 || e.of_source || f.of_source ||
           MayReach(e.ends, e.before, f.ends, f.before, lighting_, source_.normal);
  }

  // +1 if both values of a are less than both values of b, -1 for the reverse, otherwise 0.
  static int WhollyLess(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::max(a[0], a[1]) < std::min(b[0], b[1])   ? 1
           : std::max(b[0], b[1]) < std::min(a[0], a[1]) ? -1
                                                         : 0;
  }

  // True if lines through both edges can meet the polygon. On the polygon's plane, these lines meet only the
  // hull of the lines through the edges' ends.
  bool MayReach(const EdgeEnds& e, const std::array<double, 2>& e_height, const EdgeEnds& f,
                const std::array<double, 2>& f_height, const Polygon3& polygon, const Vec3& normal) const {
    std::array<Vec3, 4> at;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        at[2 * i + j] = e[i] + (e[i] - f[j]) * (e_height[i] / (f_height[j] - e_height[i]));
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 edge = polygon[(k + 1) % polygon.size()] - polygon[k], inside = normal.cross(edge);
      const double margin = options_.rounding * edge.norm();
      if (std::all_of(at.begin(), at.end(),
                      [&](const Vec3& p) { return inside.dot(p - polygon[k]) < -margin; }))
        return false;
    }
    return true;
  }

  // True if both edges belong to one convex body: a line that touches both lies in a side of the body, or
  // crosses the body.
  bool OfOneBody(const EventEdge& e, const EventEdge& f) const {
    for (const PatchEdge& a : silhouettes_.Sharing(e.number))
      for (const PatchEdge& b : silhouettes_.Sharing(f.number)) {
        if (a.patch == b.patch) return true;
        const SolidId solid = scene_.SolidOf(a.patch);
        if (solid != kNoSolid && solid == scene_.SolidOf(b.patch)) return true;
      }
    return false;
  }

  void TraceTriple(const std::array<const EventEdge*, 3>& edge) {
    const RuledSurface surface(edge[0]->ends, edge[1]->ends, edge[2]->ends);
    const RuledSurface::Ranges domain = surface.Domain();
    if (domain.size == 0) return;
    surface_ = &surface;
    edge_ = edge;
    trace_ = {{edge[0]->at, edge[1]->at, edge[2]->at}, {}};
    for (int i = 0; i < domain.size; ++i) TraceRange(domain.range[i]);
    if (!trace_.pieces.empty()) traces_.push_back(std::move(trace_));
  }

  // Between two cuts of a range no condition changes. Therefore the midpoint decides for the whole part.
  void TraceRange(const Range& range) {
    parts_ = {range};
    const std::array<double, 3> place = {range.t0, 0.5 * (range.t0 + range.t1), range.t1};
    for (int i = 0; i < 3; ++i) {
      point_[i] = surface_->Point(place[i]);
      direction_[i] = surface_->Direction(point_[i]);
    }
    // The conditions that the line meets the receiver, and passes through the source.
    cuts_.clear();
    CutAtOutline(lit_, range);
    if (!edge_[0]->of_source) CutAtOutline(lighting_, range);
    Narrow([&](const Transversal& line) {
      return ConvexContains(lit_, receiver_.normal, line.on_receiver, 0) &&
             (edge_[0]->of_source || ConvexContains(lighting_, source_.normal, line.on_source, 0));
    });
    if (parts_.empty()) return;
    // An edge's silhouette status changes where the line lies in the plane of a face.
    cuts_.clear();
    for (const EventEdge* edge : edge_)
      if (!edge->of_source)
        for (const PatchEdge& at : silhouettes_.Sharing(edge->number)) {
          const Vec3& normal = scene_.patches[at.patch].normal;
          Cut({normal.dot(direction_[0]), normal.dot(direction_[1]), normal.dot(direction_[2])}, range);
        }
    Narrow([&](const Transversal& line) {
      return std::all_of(edge_.begin(), edge_.end(), [&](const EventEdge* edge) {
        return edge->of_source || silhouettes_.IsSilhouette(edge->number, line.on_receiver);
      });
    });
    if (parts_.empty()) return;
    cuts_.clear();
    for (const Obstacle& obstacle : obstacles_) CutAtOutline(obstacle.polygon, range);
    Narrow([&](const Transversal& line) { return !Hidden(line); });
    for (const Range& part : parts_) {
      const std::optional<Transversal> from = At(part.t0), to = At(part.t1);
      if (from && to) AddPieces(part, *from, *to, 0);
    }
  }

  // Cuts where the line passes from one side of an edge of the polygon to the other.
  void CutAtOutline(const Polygon3& polygon, const Range& range) {
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec3 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      std::array<double, 3> side;
      for (int i = 0; i < 3; ++i) side[i] = direction_[i].dot((a - point_[i]).cross(b - point_[i]));
      Cut(side, range);
    }
  }

  // Cuts at the roots of the quadratic with these values at the ends and the midpoint of the range.
  void Cut(const std::array<double, 3>& value, const Range& range) {
    // Bernstein form: first (1 - s)^2 + 2 bend s (1 - s) + last s^2.
    const double first = value[0], last = value[2], bend = 2 * value[1] - 0.5 * (first + last);
    if (std::min({first, bend, last}) > 0 || std::max({first, bend, last}) < 0) return;
    const double discriminant = bend * bend - first * last;
    if (!(discriminant > 0)) return;
    const double sum = -(bend + std::copysign(std::sqrt(discriminant), bend));
    for (const double s : {sum / (sum + last), first / (first + sum)})
      if (s > 0 && s < 1) cuts_.push_back(range.t0 + s * (range.t1 - range.t0));
  }

  // Keeps those parts between cuts whose midpoint satisfies the condition.
  template <class Holds>
  void Narrow(const Holds& holds) {
    std::sort(cuts_.begin(), cuts_.end());
    narrowed_.clear();
    for (const Range& part : parts_) {
      double from = part.t0;
      const auto end_at = [&](double to) {
        const std::optional<Transversal> line = At(0.5 * (from + to));
        if (line && holds(*line)) {
          if (!narrowed_.empty() && narrowed_.back().t1 == from)
            narrowed_.back().t1 = to;
          else
            narrowed_.push_back({from, to});
        }
        from = to;
      };
      for (const double cut : cuts_)
        if (cut > from + kSameRoot && cut < part.t1 - kSameRoot) end_at(cut);
      end_at(part.t1);
    }
    std::swap(parts_, narrowed_);
  }

  // The curve between the points is an arc of a conic; the weights are the components of the line's direction
  // across the receiver. The arc's largest distance from the chord is at its shoulder, where the ends have
  // equal contributions.
  void AddPieces(const Range& range, const Transversal& from, const Transversal& to, int halvings) {
    const auto weight = [&](double t) {
      return receiver_.normal.dot(surface_->Direction(surface_->Point(t)));
    };
    const double first = weight(range.t0), last = weight(range.t1);
    const double root = std::sqrt(first / last), s = root / (1 + root);
    const double t = range.t0 + s * (range.t1 - range.t0);
    // Outside these limits, the halves would be rounding errors.
    std::optional<Transversal> shoulder;
    if (range.t0 < t && t < range.t1 && halvings < kMostHalvings) shoulder = At(t);
    // The contribution of the control point to the shoulder.
    const double share = 1 - 2 * first * (1 - s) * (1 - s) / weight(t);
    if (!shoulder || Straight(from.on_receiver, shoulder->on_receiver, to.on_receiver, share)) {
      trace_.pieces.push_back({from, to});
      return;
    }
    AddPieces({range.t0, t}, from, *shoulder, halvings + 1);
    AddPieces({t, range.t1}, *shoulder, to, halvings + 1);
  }

  bool Straight(const Vec3& from, const Vec3& shoulder, const Vec3& to, double share) const {
    if (!(share > 0)) return false;
    const Vec3 chord = to - from, bulge = shoulder - from - 0.5 * chord;
    const Vec3 control = 0.5 * chord + bulge / share;
    const double length = chord.norm(), along = control.dot(chord);
    if (std::max(length, control.norm()) <= tolerance_) return true;
    // The arc does not extend beyond the chord's ends, because it lies between the chord and the control
    // point.
    return along >= 0 && along <= length * length && chord.cross(bulge).norm() <= tolerance_ * length;
  }

  // The line at t; nothing if the line is parallel to the receiver or the source.
  std::optional<Transversal> At(double t) const {
    Transversal line;
    line.on_edge = surface_->Touched(t);
    // The two points with the largest distance give the most accurate line.
    const auto& [p, q, r] = line.on_edge;
    const double pq = (q - p).squaredNorm(), pr = (r - p).squaredNorm(), qr = (r - q).squaredNorm();
    const Vec3& a = std::max(pq, pr) >= qr ? p : q;
    const Vec3& b = pq >= std::max(pr, qr) ? q : r;
    const Vec3 way = b - a;
    line.on_receiver = a - way * (Above(a) / receiver_.normal.dot(way));
    line.on_source = edge_[0]->of_source ? p : Vec3(a - way * (Before(a) / source_.normal.dot(way)));
    if (!line.on_receiver.allFinite() || !line.on_source.allFinite()) return std::nullopt;
    return line;
  }

  bool Hidden(const Transversal& line) const {
    const Vec3 &x = line.on_receiver, &y = line.on_source;
    return std::any_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& obstacle) {
      const double hx = obstacle.normal.dot(x - obstacle.polygon[0]);
      const double hy = obstacle.normal.dot(y - obstacle.polygon[0]);
      return hx * hy < 0 && !Owns(obstacle.patch) &&
             ConvexContains(obstacle.polygon, obstacle.normal, x + (hx / (hx - hy)) * (y - x), 0);
    });
  }

  bool Owns(PatchId patch) const {
    return std::any_of(edge_.begin(), edge_.end(), [&](const EventEdge* edge) {
      const std::span<const PatchEdge> sharing = silhouettes_.Sharing(edge->number);
      return std::any_of(sharing.begin(), sharing.end(),
                         [&](const PatchEdge& at) { return at.patch == patch; });
    });
  }

  const Scene& scene_;
  const Silhouettes& silhouettes_;
  const Patch& receiver_;
  PatchId source_id_;
  const Patch& source_;
  TripleEdgeOptions options_;
  double tolerance_;
  Polygon3 lit_, lighting_;  // the parts of receiver and source in front of each other
  std::vector<EventEdge> edges_;
  std::vector<Obstacle> obstacles_;

  // The present triple and range.
  std::array<const EventEdge*, 3> edge_ = {};
  const RuledSurface* surface_ = nullptr;
  std::array<Vec3, 3> point_, direction_;  // at both ends and at the midpoint
  std::vector<double> cuts_;
  std::vector<Range> parts_, narrowed_;
  TripleEdgeTrace trace_;
  std::vector<TripleEdgeTrace> traces_;
};

}  // namespace

std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options) {
  PENUMBRA_CHECK(options.tolerance > 0);
  return Tracer(scene, silhouettes, receiver, source, options).Trace(blockers);
}

}  // namespace penumbra
