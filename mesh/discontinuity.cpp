#include "mesh/discontinuity.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "solver/base/check.h"
#include "solver/geometry/segment_clip.h"
#include "solver/scene/tolerances.h"
#include "solver/visibility/contacts.h"

namespace penumbra {
namespace {

using Coordinates = std::tuple<double, double, double>;
using EdgeKey = std::pair<Coordinates, Coordinates>;

Coordinates Key(const Vec3& p) { return {p.x() + 0.0, p.y() + 0.0, p.z() + 0.0}; }  // -0 becomes 0

EdgeKey UndirectedKey(const Vec3& a, const Vec3& b) {
  const Coordinates ka = Key(a), kb = Key(b);
  return ka < kb ? EdgeKey{ka, kb} : EdgeKey{kb, ka};
}

// An edge of a patch, from vertex k to k + 1.
struct PatchEdge {
  PatchId patch;
  std::int32_t k;
};

// What is the same for all discontinuities of one receiver.
struct Receiver {
  PatchId id;
  const Patch& patch;
  Frame frame;
  double snap;  // [m]
  double gap;   // what comes nearer touches it [m]

  double Height(const Vec3& p) const { return frame.n.dot(p - frame.origin); }
};

// How a segment's weight and origin come together; collects what is long enough.
class Collector {
 public:
  Collector(const Receiver& receiver, std::vector<Discontinuity>& found)
      : receiver_(receiver), found_(found) {}

  void Add(Discontinuity d, const Vec3& a, const Vec3& b) {
    d.receiver = receiver_.id;
    d.end = {receiver_.frame.ToPlane(a), receiver_.frame.ToPlane(b)};
    if ((d.end[1] - d.end[0]).norm() > receiver_.snap) found_.push_back(d);
  }

 private:
  const Receiver& receiver_;
  std::vector<Discontinuity>& found_;
};

// Everything about one source as the receiver sees it.
struct SourceView {
  PatchId id;
  const Patch& patch;
  double strength;  // [W/m^2]
  double rounding;  // heights below this are none [m]
  Polygon3 lit;     // the part of the receiver before the source's plane

  double Height(const Vec3& p) const { return patch.normal.dot(p - patch.vertex[0]); }
};

// True if the edge of the source and that of the blocker lie in one plane: then the gradient jumps.
bool Coplanar(const Vec3& s, const Patch& source, const Vec3& b0, const Vec3& b1, double tolerance) {
  const Vec3 normal = (b0 - s).cross(b1 - s);
  const double length = normal.norm();
  if (length == 0) return false;
  for (std::int32_t k = 0; k < source.size; ++k) {
    if (source.vertex[k] != s) continue;
    for (const std::int32_t other : {(k + 1) % source.size, (k + source.size - 1) % source.size})
      if (std::abs(normal.dot(source.vertex[other] - s)) <= tolerance * length) return true;
  }
  return false;
}

}  // namespace

struct DiscontinuityFinder::Impl {
  const Scene& scene;
  const PatchVisibility& visibility;
  std::map<EdgeKey, std::vector<PatchEdge>> edges;
  double gap;  // ContactGap() [m]

  Impl(const Scene& s, const PatchVisibility& v) : scene(s), visibility(v), gap(ContactGap(s)) {
    for (std::size_t p = 0; p < scene.patches.size(); ++p) {
      const Patch& patch = scene.patches[p];
      for (std::int32_t k = 0; k < patch.size; ++k) {
        edges[UndirectedKey(patch.vertex[k], patch.vertex[(k + 1) % patch.size])].push_back(
            {static_cast<PatchId>(p), k});
      }
    }
  }

  // False if the edge k of the blocker is no silhouette from s, or another of the blockers brings it.
  bool IsOwnSilhouette(const Vec3& s, PatchId blocker, std::int32_t k,
                       std::span<const PatchId> blockers) const {
    const Patch& patch = scene.patches[blocker];
    const Vec3& a = patch.vertex[k];
    const auto& sharing = edges.find(UndirectedKey(a, patch.vertex[(k + 1) % patch.size]))->second;
    if (sharing.size() != 2) return true;
    const PatchEdge& other = sharing[0].patch == blocker ? sharing[1] : sharing[0];
    if (other.patch == blocker) return true;
    const Patch& neighbour = scene.patches[other.patch];
    // A closed surface runs along its edges once in each direction; else one of the two is turned over.
    const double turned = neighbour.vertex[other.k] == a ? -1 : 1;
    const double own_side = patch.normal.dot(s - a), other_side = turned * neighbour.normal.dot(s - a);
    if (own_side * other_side > 0) return false;
    return blocker < other.patch || !std::binary_search(blockers.begin(), blockers.end(), other.patch);
  }

  void AddContacts(const Receiver& r, Collector& out) const;
  void AddHorizon(const Receiver& r, const SourceView& s, Collector& out) const;
  void AddVertexEdge(const Receiver& r, const SourceView& s, std::span<const PatchId> blockers,
                     double min_weight, Collector& out) const;
  void AddEdgeVertex(const Receiver& r, const SourceView& s, std::span<const PatchId> blockers,
                     double min_weight, Collector& out) const;
};

void DiscontinuityFinder::Impl::AddContacts(const Receiver& r, Collector& out) const {
  Discontinuity contact;
  contact.kind = DiscontinuityKind::kContact;
  contact.degree = DiscontinuityDegree::kD0;
  contact.geometric_weight = contact.weight = kInfiniteWeight;
  for (const Contact& found : FindContacts(scene, r.id)) {
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
  Discontinuity d;
  d.kind = DiscontinuityKind::kHorizon;
  d.degree = DiscontinuityDegree::kD1;
  d.source = s.id;
  d.geometric_weight = 1;
  d.weight = s.strength;
  out.Add(d, met[0], met[1]);
}

void DiscontinuityFinder::Impl::AddVertexEdge(const Receiver& r, const SourceView& s,
                                              std::span<const PatchId> blockers, double min_weight,
                                              Collector& out) const {
  for (const Vec3& v : s.patch.Vertices()) {
    const double hs = r.Height(v);
    if (hs <= r.snap) continue;
    for (const PatchId blocker : blockers) {
      const Patch& patch = scene.patches[blocker];
      for (std::int32_t k = 0; k < patch.size; ++k) {
        const Vec3 &a = patch.vertex[k], &b = patch.vertex[(k + 1) % patch.size];
        const double ha = r.Height(a), hb = r.Height(b);
        if (std::abs(ha) <= r.gap && std::abs(hb) <= r.gap) continue;  // a contact
        if (!IsOwnSilhouette(v, blocker, k, blockers)) continue;
        // Between the vertex and the receiver, before the source, and in the pyramid from the vertex over the
        // receiver: cut in space, so that nothing runs away to infinity.
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
        Discontinuity d;
        d.kind = DiscontinuityKind::kVE;
        d.degree =
            Coplanar(v, s.patch, a, b, s.rounding) ? DiscontinuityDegree::kD1 : DiscontinuityDegree::kD2;
        d.source = s.id;
        d.blocker = blocker;
        d.geometric_weight = std::clamp((hs - std::min(hp, hq)) / hs, 0.0, 1.0);
        d.weight = d.geometric_weight * s.strength;
        if (d.weight < min_weight) continue;
        out.Add(d, v + (p - v) * (hs / (hs - hp)), v + (q - v) * (hs / (hs - hq)));
      }
    }
  }
}

void DiscontinuityFinder::Impl::AddEdgeVertex(const Receiver& r, const SourceView& s,
                                              std::span<const PatchId> blockers, double min_weight,
                                              Collector& out) const {
  // Each corner once, though several faces of a solid meet there.
  std::map<Coordinates, PatchId> corners;
  for (const PatchId blocker : blockers)
    for (const Vec3& v : scene.patches[blocker].Vertices()) corners.try_emplace(Key(v), blocker);
  for (const auto& [key, blocker] : corners) {
    const Vec3 v(std::get<0>(key), std::get<1>(key), std::get<2>(key));
    const double hv = r.Height(v);
    if (hv <= r.gap || s.Height(v) <= s.rounding) continue;
    for (std::int32_t k = 0; k < s.patch.size; ++k) {
      const Vec3 &a = s.patch.vertex[k], &b = s.patch.vertex[(k + 1) % s.patch.size];
      const double ha = r.Height(a), hb = r.Height(b);
      // The source's points above the corner whose rays through it end on the receiver.
      SegmentClip clip;
      clip.Keep(ha - hv - s.rounding, hb - hv - s.rounding);
      for (std::size_t e = 0; e < s.lit.size() && !clip.Empty(); ++e) {
        const Vec3 side = (s.lit[e] - v).cross(s.lit[(e + 1) % s.lit.size()] - v);
        clip.Keep(side.dot(a - v), side.dot(b - v));
      }
      if (clip.Empty()) continue;
      const Vec3 p = Between(a, b, clip.t0), q = Between(a, b, clip.t1);
      const double hp = r.Height(p), hq = r.Height(q);
      Discontinuity d;
      d.kind = DiscontinuityKind::kEV;
      d.source = s.id;
      d.blocker = blocker;
      d.geometric_weight = std::clamp(1 - hv / std::max(hp, hq), 0.0, 1.0);
      d.weight = d.geometric_weight * s.strength;
      if (d.weight < min_weight) continue;
      out.Add(d, v + (v - p) * (hv / (hp - hv)), v + (v - q) * (hv / (hq - hv)));
    }
  }
}

DiscontinuityFinder::DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility)
    : impl_(std::make_unique<Impl>(scene, visibility)) {}
DiscontinuityFinder::~DiscontinuityFinder() = default;
DiscontinuityFinder::DiscontinuityFinder(DiscontinuityFinder&&) noexcept = default;

std::vector<Discontinuity> DiscontinuityFinder::Find(PatchId receiver,
                                                     std::span<const double> source_strength,
                                                     double min_weight) const {
  PENUMBRA_CHECK(source_strength.size() == impl_->scene.patches.size());
  const Patch& patch = impl_->scene.patches[receiver];
  const double snap = SnapDistance(patch);
  const Receiver r = {receiver, patch, PolygonFrame(patch.Vertices()), snap, std::max(snap, impl_->gap)};
  std::vector<Discontinuity> found;
  Collector out(r, found);
  impl_->AddContacts(r, out);
  for (const PatchPair& pair : impl_->visibility.SourcesOf(receiver)) {
    const double strength = source_strength[pair.source];
    // The geometric weight is 1 at most.
    if (!(strength > 0) || strength < min_weight) continue;
    const Patch& source = impl_->scene.patches[pair.source];
    const double rounding = std::max(r.snap, SnapDistance(source));
    const SourceView s = {pair.source, source, strength, rounding,
                          ClipToHalfSpace(patch.Vertices(), source.normal, source.vertex[0])};
    if (s.lit.empty()) continue;
    impl_->AddHorizon(r, s, out);
    const std::span<const PatchId> blockers = impl_->visibility.Blockers(pair);
    impl_->AddVertexEdge(r, s, blockers, min_weight, out);
    impl_->AddEdgeVertex(r, s, blockers, min_weight, out);
  }
  return found;
}

}  // namespace penumbra
