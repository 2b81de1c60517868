#include "solver/visibility/point_view.h"

#include <algorithm>
#include <deque>

#include "solver/visibility/form_factor.h"

namespace penumbra {

struct PointView::Buffers {
  std::vector<std::uint32_t> stamp;  // of the view that computed the entry of `view`
  std::vector<BlockerView> view;
  std::uint32_t now = 0;
  std::deque<BlockerView> cut;  // blockers cut at the plane of the source at hand; addresses stay
  std::vector<Occluder> occluders;

  void Begin(std::size_t patches) {
    if (stamp.size() < patches) {
      stamp.resize(patches, 0);
      view.resize(patches);
    }
    if (++now == 0) {
      std::fill(stamp.begin(), stamp.end(), 0U);
      now = 1;
    }
    cut.clear();
    occluders.clear();
  }
};

PointView::Buffers& PointView::ThreadBuffers() {
  thread_local Buffers buffers;
  return buffers;
}

PointView::PointView(const Scene& scene, const ReceiverPoint& at, const OcclusionMethod& method,
                     double source_push_off)
    : scene_(scene), at_(at), source_at_(at), method_(method), buffers_(ThreadBuffers()) {
  source_at_.position -= source_push_off * at.normal;
  buffers_.Begin(scene.patches.size());
}

PointView::~PointView() = default;

std::vector<Occluder>& PointView::occluder_stack() { return buffers_.occluders; }

bool PointView::FaceSource(PatchId source) {
  source_ = &scene_.patches[source];
  buffers_.cut.clear();
  const Side side = SideOf(source_at_, source_->normal, source_->vertex[0], source_->extent);
  if (side != Side::kFront && side != Side::kFrontInLimit) return false;
  source_in_contact_ = side == Side::kFrontInLimit;
  double lowest = 0, highest = 0;
  for (const Vec3& v : source_->Vertices()) {
    const double height = source_at_.normal.dot(v - source_at_.position);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  source_crosses_horizon_ = lowest < 0;
  if (highest <= 0) return false;
  if (source_in_contact_ && !SeenInContact(source_at_, source_->Vertices(), true).empty()) one_sided_ = true;
  return true;
}

DirectionPolygon PointView::SeeSource(std::span<const Vec3> part) const {
  if (source_in_contact_) return SeenInContact(source_at_, part, true);
  const DirectionPolygon seen = Seen(source_at_, part, true);
  return source_crosses_horizon_ ? ClipToHorizon(source_at_, seen, source_->extent) : seen;
}

PointView::BlockerView PointView::ViewBlocker(std::span<const Vec3> polygon, const Patch& patch) const {
  BlockerView view;
  const Side side = SideOf(at_, patch.normal, patch.vertex[0], patch.extent);
  if (side == Side::kInPlane) return view;
  const bool from_front = side == Side::kFront || side == Side::kFrontInLimit;
  view.in_limit = side == Side::kFrontInLimit || side == Side::kBackInLimit;
  view.cone =
      MakeCone(at_, view.in_limit ? SeenInContact(at_, polygon, from_front) : Seen(at_, polygon, from_front),
               patch.extent);
  return view;
}

// The blocker's part strictly between the point and the source's plane, as seen; null if it has none.
const PointView::BlockerView* PointView::FindBlocker(PatchId blocker, const DirectionPolygon& seen) {
  const Patch& patch = scene_.patches[blocker];
  const double rounding = HeightRounding(std::max(patch.extent, source_->extent));
  double lowest = 0, highest = 0;
  for (const Vec3& v : patch.Vertices()) {
    const double height = source_->normal.dot(v - source_->vertex[0]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= rounding) return nullptr;
  if (buffers_.stamp[blocker] != buffers_.now) {
    buffers_.stamp[blocker] = buffers_.now;
    buffers_.view[blocker] = ViewBlocker(patch.Vertices(), patch);
  }
  const BlockerView& whole = buffers_.view[blocker];
  if (lowest < -rounding) {
    // What misses the source as a whole misses it as a part.
    if (!whole.in_limit && whole.cone.size > 0 && Classify(whole.cone, seen) == Overlap::kNone)
      return nullptr;
    const Polygon3 before = ClipToHalfSpace(patch.Vertices(), source_->normal, source_->vertex[0], rounding);
    if (before.empty()) return nullptr;
    return &buffers_.cut.emplace_back(ViewBlocker(before, patch));
  }
  return &whole;
}

bool PointView::FindBlockers(std::span<const PatchId> candidates, PatchId own, const DirectionPolygon& seen,
                             std::vector<Occluder>& occluders) {
  const std::size_t before = occluders.size();
  for (const PatchId blocker : candidates) {
    if (blocker == own || &scene_.patches[blocker] == source_) continue;
    const BlockerView* view = FindBlocker(blocker, seen);
    if (!view || view->cone.size == 0) continue;
    const Overlap overlap = Classify(view->cone, seen);
    if (overlap == Overlap::kNone) continue;
    one_sided_ = one_sided_ || view->in_limit;
    if (overlap == Overlap::kAll) {
      occluders.resize(before);
      return false;
    }
    occluders.push_back(view->cone);
  }
  return true;
}

double PointView::VisibleFormFactor(const DirectionPolygon& seen, std::span<const Occluder> occluders) const {
  return occluders.empty() ? FormFactor(seen, at_.normal)
                           : method_.VisibleFormFactor(seen, occluders, at_.normal);
}

}  // namespace penumbra
