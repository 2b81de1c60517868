#include "mesh/discontinuities/discontinuity.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "mesh/discontinuities/irradiance_jump.h"
#include "mesh/discontinuities/triple_edge.h"
#include "mesh/discontinuities/wedge_clip.h"
#include "solver/base/check.h"
#include "solver/geometry/segment_clip.h"
#include "solver/scene/contacts.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

using Blockers = std::span<const PatchId>;

// The data that all discontinuities of one receiver share.
struct Receiver {
  PatchId id;
  const Patch& patch;
  Frame frame;
  double snap;  // [m]
  double gap;   // whatever is closer touches it [m]

  double Height(const Vec3& p) const { return frame.n.dot(p - frame.origin); }
};

// A source as seen from the receiver.
struct SourceView {
  PatchId id;
  const Patch& patch;
  double strength;  // [W/m^2]
  double rounding;  // heights below this count as zero [m]
  Polygon3 lit;     // the part of the receiver in front of the source's plane

  double Height(const Vec3& p) const { return patch.normal.dot(p - patch.vertex[0]); }
};

// A discontinuity that a source causes; `part` is the source's vertex or edge, or -1.
Discontinuity EventOf(DiscontinuityKind kind, const SourceView& source, std::int32_t part) {
  Discontinuity d;
  d.kind = kind;
  d.source = source.id;
  d.source_part = part;
  d.strength = source.strength;
  return d;
}

}  // namespace

double KinkError(double size, double margin) { return std::min(kKinkError * size, margin); }

double BendError(double size, double margin) {
  return std::min(kBendError * size * size, 0.5 * margin * margin);
}

double Weight(const Discontinuity& d, DiscontinuityWeight kind, double size, double margin) {
  if (d.kind == DiscontinuityKind::kContact) return kInfiniteWeight;
  if (kind == DiscontinuityWeight::kThesis) return d.geometric_weight * d.strength;
  double largest = 0;
  const double kinked = KinkError(size, margin), bent = BendError(size, margin);
  for (const IrradianceJump& jump : d.jump) {
    const double kink = std::max(std::abs(jump.gradient), jump.largest_gradient);
    largest =
        std::max(largest, std::min({jump.largest_value, kinked * kink, bent * std::abs(jump.curvature)}));
  }
  return largest * d.strength;
}

struct DiscontinuityFinder::Impl {
  const Scene& scene;
  const PatchVisibility& visibility;
  Silhouettes silhouettes;
  double gap;  // ContactGap() [m]
  ContactSearch contacts;

  Impl(const Scene& s, const PatchVisibility& v)
      : scene(s), visibility(v), silhouettes(s), gap(ContactGap(s)), contacts(s) {}

  // Computes weights and jumps, and keeps the discontinuities of sufficient length and weight.
  class Collector {
   public:
    Collector(const Impl& finder, const Receiver& receiver, const DiscontinuityOptions& options,
              const ExecutionContext& context, std::vector<Discontinuity>& found)
        : finder_(finder),
          receiver_(receiver),
          options_(options),
          context_(context),
          size_(std::sqrt(receiver.patch.area)),
          found_(found) {}

    bool Cancelled() const { return context_.Cancelled(); }
    bool TooLight(double weight) const {
      return options_.weight == DiscontinuityWeight::kThesis && weight < options_.min_weight;
    }

    void Add(Discontinuity d, const Vec3& a, const Vec3& b) {
      d.receiver = receiver_.id;
      d.end = {receiver_.frame.ToPlane(a), receiver_.frame.ToPlane(b)};
      if ((d.end[1] - d.end[0]).norm() <= receiver_.snap) return;
      for (int i = 0; i < Discontinuity::kJumps; ++i) {
        const double t = (i + 0.5) / Discontinuity::kJumps;
        d.jump[i] = finder_.JumpOf(receiver_, d, (1 - t) * d.end[0] + t * d.end[1]);
      }
      d.weight = Weight(d, options_.weight, size_);
      if (d.weight >= options_.min_weight) found_.push_back(d);
    }

    // Adds the parts of a wedge's trace that are visible past the blockers, except blockers that contain the
    // wedge's vertex and edge.
    void AddWedge(const Discontinuity& d, Wedge& wedge, const SourceView& s, Blockers blockers,
                  const std::function<bool(PatchId)>& touches) {
      TraceParts trace;
      if (!options_.keep_hidden) {
        wedge.normal = (wedge.end[0] - wedge.apex).cross(wedge.end[1] - wedge.apex);
        const double length = wedge.normal.norm();
        if (length > 0) {
          wedge.normal /= length;
          wedge.receiver_normal = receiver_.frame.n;
          wedge.on_receiver = receiver_.frame.origin;
          wedge.source_normal = s.patch.normal;
          wedge.on_source = s.patch.vertex[0];
          wedge.rounding = s.rounding;
          for (const PatchId blocker : blockers)
            if (!touches(blocker)) trace.Hide(wedge, finder_.scene.patches[blocker]);
        }
      }
      for (const TraceParts::Part& part : trace.parts())
        Add(d, Between(wedge.end[0], wedge.end[1], part.t0), Between(wedge.end[0], wedge.end[1], part.t1));
    }

   private:
    const Impl& finder_;
    const Receiver& receiver_;
    const DiscontinuityOptions& options_;
    const ExecutionContext& context_;
    double size_;
    std::vector<Discontinuity>& found_;
  };

  // False if the blocker's edge k is no silhouette from s, or if another of the blockers adds the edge.
  bool IsOwnSilhouette(const Vec3& s, PatchId blocker, std::int32_t k, Blockers blockers) const {
    const std::int32_t edge = silhouettes.EdgeAt(blocker, k);
    if (!silhouettes.IsSilhouette(edge, s)) return false;
    const std::span<const PatchEdge> sharing = silhouettes.Sharing(edge);
    if (sharing.size() != 2) return true;
    const PatchId other = sharing[0].patch == blocker ? sharing[1].patch : sharing[0].patch;
    return blocker <= other || !std::binary_search(blockers.begin(), blockers.end(), other);
  }

  bool HasCorner(PatchId patch, std::int32_t corner) const {
    const std::span<const PatchId> around = silhouettes.PatchesAround(corner);
    return std::find(around.begin(), around.end(), patch) != around.end();
  }

  IrradianceJump JumpOf(const Receiver& r, const Discontinuity& d, const Vec2& at) const {
    const Vec2 along = (d.end[1] - d.end[0]).normalized();
    return JumpAt(scene, silhouettes, d, r.frame.FromPlane(at),
                  -along.y() * r.frame.u + along.x() * r.frame.v);
  }

  Receiver ReceiverOf(PatchId id) const {
    const Patch& patch = scene.patches[id];
    const double snap = SnapDistance(patch);
    return {id, patch, PolygonFrame(patch.Vertices()), snap, std::max(snap, gap)};
  }

  // True if a patch in the same plane continues beyond the edge.
  bool GoesOn(PatchId patch, std::int32_t k) const {
    const std::span<const PatchEdge> sharing = silhouettes.Sharing(silhouettes.EdgeAt(patch, k));
    const Patch& own = scene.patches[patch];
    return std::any_of(sharing.begin(), sharing.end(), [&](const PatchEdge& other) {
      constexpr double kOnePlane = 1 - 1e-9;  // the cosine of half a ten-thousandth of a radian
      return other.patch != patch && scene.patches[other.patch].normal.dot(own.normal) > kOnePlane;
    });
  }

  void AddContacts(const Receiver& r, Collector& out) const;
  void AddHorizon(const Receiver& r, const SourceView& s, Collector& out) const;
  void AddNearEdges(const Receiver& r, const SourceView& s, Collector& out) const;
  void AddVertexEdge(const Receiver& r, const SourceView& s, Blockers blockers, Collector& out) const;
  void AddEdgeVertex(const Receiver& r, const SourceView& s, Blockers blockers, Collector& out) const;
  void AddTripleEdges(const Receiver& r, const SourceView& s, Blockers blockers,
                      const DiscontinuityOptions& options, Collector& out) const;
  void AddCornerEvents(const Receiver& r, const SourceView& s, Blockers blockers, PatchId blocker,
                       std::int32_t part, Collector& out) const;
  void MarkShared(const SourceView& s, std::int32_t source_edge, std::int32_t corner, const Vec3& from,
                  Discontinuity* d) const;
};

void DiscontinuityFinder::Impl::AddContacts(const Receiver& r, Collector& out) const {
  Discontinuity contact;
  contact.kind = DiscontinuityKind::kContact;
  contact.degree = DiscontinuityDegree::kD0;
  contact.geometric_weight = kInfiniteWeight;
  for (const Contact& found : contacts.Find(r.id)) {
    contact.blocker = found.other;
    out.Add(contact, found.a, found.b);
  }
}

void DiscontinuityFinder::Impl::AddHorizon(const Receiver& r, const SourceView& s, Collector& out) const {
  std::vector<Vec3> met;
  bool before = false, behind = false;
  for (std::int32_t k = 0; k < r.patch.size; ++k) {
    const Vec3 &a = r.patch.vertex[k], &b = r.patch.vertex[(k + 1) % r.patch.size];
    const double ha = s.Height(a), hb = s.Height(b);
    const bool on = std::abs(ha) <= s.rounding;
    before |= ha > s.rounding;
    behind |= ha < -s.rounding;
    if (on) met.push_back(a);
    if (!on && std::abs(hb) > s.rounding && ha * hb < 0) met.push_back(Between(a, b, ha / (ha - hb)));
  }
  if (!before || !behind || met.size() != 2) return;
  Discontinuity d = EventOf(DiscontinuityKind::kHorizon, s, -1);
  d.degree = DiscontinuityDegree::kD1;
  d.geometric_weight = 1;
  out.Add(d, met[0], met[1]);
}

// Adds lines along the edges of the source that hang closely above the receiver. The distance of the lines
// from the edge, on either side, is kOffsets times the edge's height: near the edge, in steps of half the
// height, within which the irradiance falls; farther away, in ratios that a quadratic can follow.
void DiscontinuityFinder::Impl::AddNearEdges(const Receiver& r, const SourceView& s, Collector& out) const {
  constexpr double kOffsets[] = {0, 0.5, 1, 1.7, 2.9, 5, 8.5, 14.5};
  for (std::int32_t k = 0; k < s.patch.size; ++k) {
    const Vec3 &a = s.patch.vertex[k], &b = s.patch.vertex[(k + 1) % s.patch.size];
    const double ha = r.Height(a), hb = r.Height(b);
    if (std::min(ha, hb) <= r.gap || std::max(ha, hb) > kMaxHangingHeight * (b - a).norm()) continue;
    if (GoesOn(s.id, k)) continue;
    const Vec3 across = r.frame.n.cross(b - a).normalized();
    Discontinuity d = EventOf(DiscontinuityKind::kNear, s, k);
    d.geometric_weight = 1;
    for (const double offset : kOffsets)
      for (const double side : {-1.0, 1.0}) {
        if (offset == 0 && side > 0) continue;
        const Vec3 p = a - ha * r.frame.n + side * offset * ha * across;
        const Vec3 q = b - hb * r.frame.n + side * offset * hb * across;
        if (const auto kept = ClipToPolygon(p, q, s.lit, r.frame.n, 0)) out.Add(d, (*kept)[0], (*kept)[1]);
      }
  }
}

void DiscontinuityFinder::Impl::AddVertexEdge(const Receiver& r, const SourceView& s, Blockers blockers,
                                              Collector& out) const {
  for (std::int32_t part = 0; part < s.patch.size; ++part) {
    const Vec3& v = s.patch.vertex[part];
    const double hs = r.Height(v);
    if (hs <= r.snap) continue;
    for (const PatchId blocker : blockers) {
      if (out.Cancelled()) return;
      const Patch& patch = scene.patches[blocker];
      for (std::int32_t k = 0; k < patch.size; ++k) {
        const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % patch.size];
        const double ha = r.Height(a), hb = r.Height(b);
        if (std::abs(ha) <= r.gap && std::abs(hb) <= r.gap) continue;  // a contact
        if (!IsOwnSilhouette(v, blocker, k, blockers)) continue;
        // Clips the edge in space, so that no projection is infinite: to the slab between the vertex and the
        // receiver, to the front of the source, and to the pyramid from the vertex over the receiver.
        SegmentClip clip;
        clip.Keep(ha + r.snap, hb + r.snap);
        clip.Keep(hs - ha - s.rounding, hs - hb - s.rounding);
        clip.Keep(s.Height(a) - s.rounding, s.Height(b) - s.rounding);
        for (std::size_t e = 0; e < s.lit.size() && !clip.Empty(); ++e) {
          const Vec3 side = (s.lit[e] - v).cross(s.lit[(e + 1) % s.lit.size()] - v);
          clip.Keep(-side.dot(a - v), -side.dot(b - v));
        }
        if (clip.Empty()) continue;
        const Vec3 p = Between(a, b, clip.t0), q = Between(a, b, clip.t1);
        const double hp = r.Height(p), hq = r.Height(q);
        Discontinuity d = EventOf(DiscontinuityKind::kVE, s, part);
        d.blocker = blocker;
        d.blocker_part = k;
        d.geometric_weight = std::clamp((hs - std::min(hp, hq)) / hs, 0.0, 1.0);
        if (out.TooLight(d.geometric_weight * s.strength)) continue;
        d.shared_source_edge = CoplanarEdge(s.patch, part, a, b, s.rounding);
        if (d.shared_source_edge >= 0) {
          d.degree = DiscontinuityDegree::kD1;
          d.shared_blocker_edge = {blocker, k};
        }
        Wedge wedge;
        wedge.apex = v;
        wedge.apex_height = hs;
        wedge.end = {v + (p - v) * (hs / (hs - hp)), v + (q - v) * (hs / (hs - hq))};
        const std::int32_t from = silhouettes.CornerAt(blocker, k);
        const std::int32_t to = silhouettes.CornerAt(blocker, (k + 1) % patch.size);
        out.AddWedge(d, wedge, s, blockers,
                     [&](PatchId other) { return HasCorner(other, from) && HasCorner(other, to); });
      }
    }
  }
}

void DiscontinuityFinder::Impl::AddEdgeVertex(const Receiver& r, const SourceView& s, Blockers blockers,
                                              Collector& out) const {
  // Each corner once, although several faces of a solid may share it.
  struct Use {
    std::int32_t corner;
    PatchId blocker;
    std::int32_t part;
  };
  std::vector<Use> corners;
  for (const PatchId blocker : blockers)
    for (std::int32_t k = 0; k < scene.patches[blocker].size; ++k)
      corners.push_back({silhouettes.CornerAt(blocker, k), blocker, k});
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Use& a, const Use& b) { return a.corner < b.corner; });
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (out.Cancelled()) return;
    if (i > 0 && corners[i].corner == corners[i - 1].corner) continue;
    AddCornerEvents(r, s, blockers, corners[i].blocker, corners[i].part, out);
  }
}

void DiscontinuityFinder::Impl::AddCornerEvents(const Receiver& r, const SourceView& s, Blockers blockers,
                                                PatchId blocker, std::int32_t part, Collector& out) const {
  const std::int32_t corner = silhouettes.CornerAt(blocker, part);
  const Vec3& v = silhouettes.Position(corner);
  const double hv = r.Height(v);
  if (hv <= r.gap || s.Height(v) <= s.rounding) return;
  for (std::int32_t k = 0; k < s.patch.size; ++k) {
    const Vec3 &a = s.patch.vertex[k], &b = s.patch.vertex[(k + 1) % s.patch.size];
    const double ha = r.Height(a), hb = r.Height(b);
    // The points of the source's edge above the corner whose lines through the corner end on the receiver.
    SegmentClip clip;
    clip.Keep(ha - hv - s.rounding, hb - hv - s.rounding);
    for (std::size_t e = 0; e < s.lit.size() && !clip.Empty(); ++e) {
      const Vec3 side = (s.lit[e] - v).cross(s.lit[(e + 1) % s.lit.size()] - v);
      clip.Keep(side.dot(a - v), side.dot(b - v));
    }
    if (clip.Empty()) continue;
    // The set of the corner's silhouette edges changes where the source's edge crosses a face's plane.
    std::vector<double> cut = {clip.t0, clip.t1};
    for (const PatchId face : silhouettes.PatchesAround(corner)) {
      const Patch& patch = scene.patches[face];
      const double fa = patch.normal.dot(a - v), fb = patch.normal.dot(b - v);
      if (fa * fb < 0 && fa / (fa - fb) > clip.t0 && fa / (fa - fb) < clip.t1) cut.push_back(fa / (fa - fb));
    }
    std::sort(cut.begin(), cut.end());
    for (std::size_t i = 0; i + 1 < cut.size(); ++i) {
      if (!(cut[i] < cut[i + 1])) continue;
      const Vec3 p = Between(a, b, cut[i]), q = Between(a, b, cut[i + 1]);
      const double hp = r.Height(p), hq = r.Height(q);
      Discontinuity d = EventOf(DiscontinuityKind::kEV, s, k);
      d.blocker = blocker;
      d.blocker_part = part;
      d.geometric_weight = std::clamp(1 - hv / std::max(hp, hq), 0.0, 1.0);
      if (out.TooLight(d.geometric_weight * s.strength)) continue;
      const Vec3 middle = 0.5 * (p + q);
      std::vector<Vec3> outline;  // the silhouette edges at the corner
      for (const std::int32_t edge : silhouettes.EdgesAround(corner))
        if (silhouettes.IsSilhouette(edge, middle)) outline.push_back(silhouettes.Away(edge, corner));
      if (outline.size() < 2) continue;
      const double bend = outline[0].cross(outline[1]).norm();
      if (outline.size() == 2 && outline[0].dot(outline[1]) < 0 &&
          bend <= s.rounding * std::max(outline[0].norm(), outline[1].norm()))
        continue;  // the silhouette continues straight
      MarkShared(s, k, corner, middle, &d);
      Wedge wedge;
      wedge.apex = v;
      wedge.apex_height = hv;
      wedge.through_apex = true;
      wedge.end = {v + (v - p) * (hv / (hp - hv)), v + (v - q) * (hv / (hq - hv))};
      out.AddWedge(d, wedge, s, blockers, [&](PatchId other) { return HasCorner(other, corner); });
    }
  }
}

void DiscontinuityFinder::Impl::AddTripleEdges(const Receiver& r, const SourceView& s, Blockers blockers,
                                               const DiscontinuityOptions& options, Collector& out) const {
  const TripleEdgeOptions tracing = {options.triple_edge_tolerance, options.keep_hidden, r.gap, s.rounding};
  for (const TripleEdgeTrace& trace : TraceTripleEdges(scene, silhouettes, r.id, s.id, blockers, tracing))
    for (const TripleEdgeTrace::Piece& piece : trace.pieces) {
      Discontinuity d;
      d.kind = DiscontinuityKind::kEEE;
      d.source = s.id;
      const bool of_source = trace.edge[0].patch == s.id;
      if (of_source) d.source_part = trace.edge[0].k;
      const PatchEdge& first = trace.edge[of_source ? 1 : 0];
      d.blocker = first.patch;
      d.blocker_part = first.k;
      d.second_blocker_edge = trace.edge[of_source ? 2 : 1];
      if (!of_source) d.third_blocker_edge = trace.edge[2];
      d.strength = s.strength;
      for (const Transversal* line : {&piece.from, &piece.to}) {
        double lowest = r.Height(line->on_source);
        const double source_height = lowest;
        for (const Vec3& p : line->on_edge) lowest = std::min(lowest, r.Height(p));
        d.geometric_weight = std::max(d.geometric_weight, std::clamp(1 - lowest / source_height, 0.0, 1.0));
      }
      if (out.TooLight(d.geometric_weight * s.strength)) continue;
      // Rounding may move the ends beyond the receiver.
      SegmentClip clip;
      const Vec3 &a = piece.from.on_receiver, &b = piece.to.on_receiver;
      for (std::size_t e = 0; e < s.lit.size() && !clip.Empty(); ++e) {
        const Vec3 side = r.frame.n.cross(s.lit[(e + 1) % s.lit.size()] - s.lit[e]);
        clip.Keep(side.dot(a - s.lit[e]), side.dot(b - s.lit[e]));
      }
      if (!clip.Empty()) out.Add(d, Between(a, b, clip.t0), Between(a, b, clip.t1));
    }
}

// Marks the discontinuity as D1 if a silhouette edge at the corner lies in one plane with the source's edge.
void DiscontinuityFinder::Impl::MarkShared(const SourceView& s, std::int32_t source_edge, std::int32_t corner,
                                           const Vec3& from, Discontinuity* d) const {
  const Vec3& v = silhouettes.Position(corner);
  const Vec3 &a = s.patch.vertex[source_edge], &b = s.patch.vertex[(source_edge + 1) % s.patch.size];
  const Vec3 plane = (a - v).cross(b - v);
  const double length = plane.norm();
  for (const std::int32_t edge : silhouettes.EdgesAround(corner)) {
    if (std::abs(plane.dot(silhouettes.Away(edge, corner))) > s.rounding * length) continue;
    if (!silhouettes.IsSilhouette(edge, from)) continue;
    d->degree = DiscontinuityDegree::kD1;
    d->shared_source_edge = source_edge;
    d->shared_blocker_edge = silhouettes.Sharing(edge).front();
    return;
  }
}

DiscontinuityFinder::DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility)
    : impl_(std::make_unique<Impl>(scene, visibility)) {}
DiscontinuityFinder::~DiscontinuityFinder() = default;
DiscontinuityFinder::DiscontinuityFinder(DiscontinuityFinder&&) noexcept = default;

std::vector<Discontinuity> DiscontinuityFinder::Find(PatchId receiver,
                                                     std::span<const double> source_strength,
                                                     const DiscontinuityOptions& options,
                                                     const ExecutionContext& context) const {
  PENUMBRA_CHECK(source_strength.size() == impl_->scene.patches.size());
  std::vector<Discontinuity> found = FindContacts(receiver, options);
  for (const PatchPair& pair : impl_->visibility.SourcesOf(receiver)) {
    if (context.Cancelled()) break;
    const std::vector<Discontinuity> more =
        FindFrom(receiver, pair, source_strength[pair.source], options, context);
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

std::vector<Discontinuity> DiscontinuityFinder::FindContacts(PatchId receiver,
                                                             const DiscontinuityOptions& options) const {
  const Receiver r = impl_->ReceiverOf(receiver);
  std::vector<Discontinuity> found;
  const ExecutionContext whole;
  Impl::Collector out(*impl_, r, options, whole, found);
  impl_->AddContacts(r, out);
  return found;
}

std::vector<Discontinuity> DiscontinuityFinder::FindFrom(PatchId receiver, const PatchPair& pair,
                                                         double strength, const DiscontinuityOptions& options,
                                                         const ExecutionContext& context) const {
  std::vector<Discontinuity> found;
  if (!Counts(strength, options)) return found;
  const Receiver r = impl_->ReceiverOf(receiver);
  Impl::Collector out(*impl_, r, options, context, found);
  const Patch& source = impl_->scene.patches[pair.source];
  const double rounding = std::max(r.snap, SnapDistance(source));
  const SourceView s = {pair.source, source, strength, rounding,
                        ClipToHalfSpace(r.patch.Vertices(), source.normal, source.vertex[0])};
  if (s.lit.empty()) return found;
  impl_->AddHorizon(r, s, out);
  impl_->AddNearEdges(r, s, out);
  const Blockers blockers = impl_->visibility.Blockers(pair);
  impl_->AddVertexEdge(r, s, blockers, out);
  impl_->AddEdgeVertex(r, s, blockers, out);
  if (options.triple_edge_tolerance > 0 && !context.Cancelled())
    impl_->AddTripleEdges(r, s, blockers, options, out);
  return found;
}

IrradianceJump DiscontinuityFinder::Jump(const Discontinuity& d, const Vec2& at) const {
  return impl_->JumpOf(impl_->ReceiverOf(d.receiver), d, at);
}

}  // namespace penumbra
