#include "mesh/triple_edge.h"

#include <algorithm>
#include <cmath>

#include "solver/base/check.h"
#include "solver/geometry/polygon.h"
#include "solver/geometry/segment_clip.h"

namespace penumbra {
namespace {

// Each range of the domain is cut into this many parts at first, so that no bend between them is overlooked:
// a conic is convex, and bends little in an eighth of its range.
constexpr int kFirstParts = 8;
// A part is halved at most so often: the ends of what is seen are then known to 1e-6 of the range.
constexpr int kMostHalvings = 18;

// Six times the volume between the edges' ends, and what it is to be compared with.
bool LieInOnePlane(const EdgeEnds& e, const EdgeEnds& f, double rounding) {
  const Vec3 d = e[1] - e[0], g = f[1] - f[0], across = d.cross(g);
  const double area = across.norm();
  // Parallel: the sine of the angle is within rounding of the shorter one's length.
  if (area * std::min(d.norm(), g.norm()) <= rounding * d.norm() * g.norm()) return true;
  return std::abs(across.dot(f[0] - e[0])) <= rounding * area;
}

// The point on the edge in the plane through p with this normal.
Vec3 OnPlane(const EdgeEnds& edge, const Vec3& p, const Vec3& normal) {
  const double f0 = normal.dot(edge[0] - p), f1 = normal.dot(edge[1] - p);
  return Between(edge[0], edge[1], std::clamp(f0 / (f0 - f1), 0.0, 1.0));
}

}  // namespace

bool RuledSurface::Skew(double rounding) const {
  return !LieInOnePlane(source_, first_, rounding) && !LieInOnePlane(source_, second_, rounding) &&
         !LieInOnePlane(first_, second_, rounding);
}

std::vector<RuledSurface::Range> RuledSurface::Domain() const {
  // The line touches the first edge where the ends of that lie on different sides of the plane through the
  // source's point and the second edge, and the other way about. Each side is linear in the source's point.
  const auto side = [](const EdgeEnds& edge, const Vec3& end, const Vec3& p) {
    return (edge[0] - p).cross(edge[1] - p).dot(end - p);
  };
  std::array<std::array<double, 2>, 4> value;  // at both ends of the source's edge
  for (int k = 0; k < 2; ++k)
    for (int end = 0; end < 2; ++end) {
      value[2 * 0 + k][end] = side(second_, first_[k], source_[end]);
      value[2 * 1 + k][end] = side(first_, second_[k], source_[end]);
    }
  std::vector<double> cut = {0, 1};
  for (const auto& [a, b] : value)
    if (a * b < 0) cut.push_back(a / (a - b));
  std::sort(cut.begin(), cut.end());
  std::vector<Range> domain;
  for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
    if (!(cut[i] < cut[i + 1])) continue;
    const double t = 0.5 * (cut[i] + cut[i + 1]);
    const auto at = [&](int f) { return (1 - t) * value[f][0] + t * value[f][1]; };
    if (at(0) * at(1) >= 0 || at(2) * at(3) >= 0) continue;
    if (!domain.empty() && domain.back().t1 == cut[i])
      domain.back().t1 = cut[i + 1];
    else
      domain.push_back({cut[i], cut[i + 1]});
  }
  return domain;
}

std::optional<Transversal> RuledSurface::At(double t) const {
  Transversal line;
  const Vec3& p = line.on_edge[0] = Between(source_[0], source_[1], t);
  const Vec3 through_first = (first_[0] - p).cross(first_[1] - p);
  const Vec3 through_second = (second_[0] - p).cross(second_[1] - p);
  const Vec3& q = line.on_edge[1] = OnPlane(first_, p, through_second);
  const Vec3& r = line.on_edge[2] = OnPlane(second_, p, through_first);
  if (!((q - p).dot(r - p) > 0)) return std::nullopt;
  // The farther of the two gives the line more digits.
  const Vec3& far = (q - p).squaredNorm() >= (r - p).squaredNorm() ? q : r;
  const double from = normal_.dot(p - origin_), to = normal_.dot(far - origin_);
  if (!(to > 0 && from > to)) return std::nullopt;
  line.on_receiver = p + (far - p) * (from / (from - to));
  if (!line.on_receiver.allFinite()) return std::nullopt;
  return line;
}

namespace {

// An edge of blockers, once, though two faces share it.
struct BlockerEdge {
  std::int32_t number;  // Silhouettes::EdgeAt()
  PatchEdge at;
  EdgeEnds ends;
  std::array<std::int32_t, 2> corner;
};

// Finds the traces for one receiver and source.
class Tracer {
 public:
  Tracer(const Scene& scene, const Silhouettes& silhouettes, PatchId receiver, PatchId source,
         std::span<const PatchId> blockers, const TripleEdgeOptions& options)
      : scene_(scene),
        silhouettes_(silhouettes),
        receiver_(scene.patches[receiver]),
        source_(scene.patches[source]),
        blockers_(blockers),
        options_(options) {
    for (const Vec3& v : receiver_.Vertices()) box_.extend(v);
    const Vec3 margin = Vec3::Constant(options.tolerance);
    box_ = Eigen::AlignedBox3d(box_.min() - margin, box_.max() + margin);
  }

  std::vector<TripleEdgeTrace> Trace() {
    const std::vector<BlockerEdge> edges = CollectEdges();
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t j = i + 1; j < edges.size(); ++j)
        if (!Touch(edges[i], edges[j])) TracePair(edges[i], edges[j]);
    return std::move(traces_);
  }

 private:
  // What the subdivision knows of a point of the curve; nothing where there is no event.
  using Point = std::optional<Transversal>;

  double Height(const Vec3& p) const { return receiver_.normal.dot(p - receiver_.vertex[0]); }
  double BeforeSource(const Vec3& p) const { return source_.normal.dot(p - source_.vertex[0]); }

  std::vector<BlockerEdge> CollectEdges() const {
    std::vector<BlockerEdge> edges;
    for (const PatchId blocker : blockers_) {
      const Patch& patch = scene_.patches[blocker];
      for (std::int32_t k = 0; k < patch.size; ++k) {
        const std::int32_t next = (k + 1) % patch.size;
        const Vec3 &a = patch.vertex[k], &b = patch.vertex[next];
        // Above the receiver, and before the source.
        if (std::max(Height(a), Height(b)) <= options_.gap) continue;
        if (std::max(BeforeSource(a), BeforeSource(b)) <= options_.rounding) continue;
        edges.push_back({silhouettes_.EdgeAt(blocker, k),
                         {blocker, k},
                         {a, b},
                         {silhouettes_.CornerAt(blocker, k), silhouettes_.CornerAt(blocker, next)}});
      }
    }
    std::stable_sort(edges.begin(), edges.end(),
                     [](const BlockerEdge& e, const BlockerEdge& f) { return e.number < f.number; });
    edges.erase(std::unique(edges.begin(), edges.end(),
                            [](const BlockerEdge& e, const BlockerEdge& f) { return e.number == f.number; }),
                edges.end());
    return edges;
  }

  // Edges of one patch, or with a common end, never appear to cross.
  bool Touch(const BlockerEdge& e, const BlockerEdge& f) const {
    for (const std::int32_t c : e.corner)
      if (c == f.corner[0] || c == f.corner[1]) return true;
    for (const PatchEdge& a : silhouettes_.Sharing(e.number))
      for (const PatchEdge& b : silhouettes_.Sharing(f.number))
        if (a.patch == b.patch) return true;
    return false;
  }

  void TracePair(const BlockerEdge& first, const BlockerEdge& second) {
    first_ = &first;
    second_ = &second;
    for (std::int32_t k = 0; k < source_.size; ++k) {
      const RuledSurface surface({source_.vertex[k], source_.vertex[(k + 1) % source_.size]}, first.ends,
                                 second.ends, receiver_.vertex[0], receiver_.normal);
      const std::vector<RuledSurface::Range> domain = surface.Domain();
      if (domain.empty() || !surface.Skew(options_.rounding)) continue;
      surface_ = &surface;
      trace_ = {k, first.at, second.at, {}};
      for (const RuledSurface::Range& range : domain) TraceRange(range);
      if (!trace_.pieces.empty()) traces_.push_back(std::move(trace_));
    }
  }

  void TraceRange(const RuledSurface::Range& range) {
    double t = range.t0;
    Point from = At(t);
    for (int i = 1; i <= kFirstParts; ++i) {
      const double next = i == kFirstParts ? range.t1 : range.t0 + (range.t1 - range.t0) * i / kFirstParts;
      const Point to = At(next);
      Divide(t, from, next, to, 0);
      t = next;
      from = to;
    }
  }

  // Adds the pieces between t0 and t1.
  void Divide(double t0, const Point& from, double t1, const Point& to, int halvings) {
    const double middle = 0.5 * (t0 + t1);
    const Point half = At(middle);
    const bool any = from || half || to, all = from && half && to;
    // A conic's arc lies within twice of what its quarters are off the chord.
    if (all && Straight(*from, At(t0 + 0.25 * (t1 - t0)), *half, At(t0 + 0.75 * (t1 - t0)), *to)) {
      trace_.pieces.push_back({*from, *to});
      return;
    }
    if (halvings >= kMostHalvings || (!any && halvings > 1)) return;
    Divide(t0, from, middle, half, halvings + 1);
    Divide(middle, half, t1, to, halvings + 1);
  }

  bool Straight(const Transversal& from, const Point& quarter, const Transversal& half, const Point& last,
                const Transversal& to) const {
    if (!quarter || !last) return false;
    const Vec3 chord = to.on_receiver - from.on_receiver;
    const double length = chord.norm();
    if (!(length > 0)) return false;
    const auto off = [&](const Transversal& point) {
      return chord.cross(point.on_receiver - from.on_receiver).norm() / length;
    };
    return std::max({off(*quarter), off(half), off(*last)}) <= 0.5 * options_.tolerance;
  }

  // The event at t, if it happens on the receiver and nothing hides it.
  Point At(double t) const {
    Point line = surface_->At(t);
    if (!line) return line;
    const Vec3& x = line->on_receiver;
    if (!box_.contains(x) || BeforeSource(x) <= options_.rounding) return std::nullopt;
    for (const int k : {1, 2}) {
      if (Height(line->on_edge[k]) <= options_.gap) return std::nullopt;
      if (BeforeSource(line->on_edge[k]) <= options_.rounding) return std::nullopt;
    }
    if (!silhouettes_.IsSilhouette(first_->number, x) || !silhouettes_.IsSilhouette(second_->number, x))
      return std::nullopt;
    if (!options_.keep_hidden && Hidden(*line)) return std::nullopt;
    return line;
  }

  bool Owns(PatchId patch) const {
    for (const BlockerEdge* edge : {first_, second_})
      for (const PatchEdge& at : silhouettes_.Sharing(edge->number))
        if (at.patch == patch) return true;
    return false;
  }

  bool Hidden(const Transversal& line) const {
    const Vec3 &x = line.on_receiver, &y = line.on_edge[0];
    return std::any_of(blockers_.begin(), blockers_.end(), [&](PatchId blocker) {
      if (Owns(blocker)) return false;
      const Patch& patch = scene_.patches[blocker];
      const double hx = patch.normal.dot(x - patch.vertex[0]), hy = patch.normal.dot(y - patch.vertex[0]);
      if (!(hx * hy < 0)) return false;
      return ConvexContains(patch.Vertices(), patch.normal, x + (hx / (hx - hy)) * (y - x), 0);
    });
  }

  const Scene& scene_;
  const Silhouettes& silhouettes_;
  const Patch &receiver_, &source_;
  std::span<const PatchId> blockers_;
  TripleEdgeOptions options_;
  Eigen::AlignedBox3d box_;
  const BlockerEdge *first_ = nullptr, *second_ = nullptr;
  const RuledSurface* surface_ = nullptr;
  TripleEdgeTrace trace_;
  std::vector<TripleEdgeTrace> traces_;
};

}  // namespace

std::vector<TripleEdgeTrace> TraceTripleEdges(const Scene& scene, const Silhouettes& silhouettes,
                                              PatchId receiver, PatchId source,
                                              std::span<const PatchId> blockers,
                                              const TripleEdgeOptions& options) {
  PENUMBRA_CHECK(options.tolerance > 0);
  return Tracer(scene, silhouettes, receiver, source, blockers, options).Trace();
}

}  // namespace penumbra
