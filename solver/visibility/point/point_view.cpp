#include "solver/visibility/point/point_view.h"

#include <algorithm>
#include <deque>

#include "solver/base/lazy_table.h"
#include "solver/visibility/point/form_factor.h"
#include "solver/visibility/point/solid_outline.h"

namespace penumbra {

struct PointView::Buffers {
  LazyTable<BlockerView> patches, solids;  // whole patches and solids as seen from the point
  LazyTable<char> as_one;  // for each solid, in one search for blockers: its outline replaces its patches
  std::deque<BlockerView> cut;  // blockers cut at the plane of the current source; addresses stay valid
  std::vector<Occluder> occluders;

  void Clear() {
    patches.Clear();
    solids.Clear();
    as_one.Clear();
    cut.clear();
    occluders.clear();
  }
};

PointView::PointView(const Scene& scene, const ReceiverPoint& at, const OcclusionMethod& method,
                     double source_push_off)
    : scene_(scene), at_(at), source_at_(at), method_(method) {
  source_at_.position -= source_push_off * at.normal;
  buffers_->patches.Begin(scene.patches.size());
  buffers_->solids.Begin(scene.solids.size());
}

PointView::~PointView() = default;

std::vector<Occluder>& PointView::occluder_stack() { return buffers_->occluders; }

bool PointView::FaceSource(PatchId source) {
  source_ = &scene_.patches[source];
  source_solid_ = scene_.SolidOf(source);
  buffers_->cut.clear();
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

namespace {

// The smallest and the largest of 0 and the heights of the vertices above the source's plane.
std::pair<double, double> HeightsBefore(const Patch& source, std::span<const Vec3> vertices) {
  double lowest = 0, highest = 0;
  for (const Vec3& v : vertices) {
    const double height = source.normal.dot(v - source.vertex[0]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  return {lowest, highest};
}

}  // namespace

// The view of the blocker's part strictly between the point and the source's plane; null if there is none.
const PointView::BlockerView* PointView::FindBlocker(PatchId blocker, const DirectionPolygon& seen) {
  const Patch& patch = scene_.patches[blocker];
  const double rounding = HeightRounding(std::max(patch.extent, source_->extent));
  const auto [lowest, highest] = HeightsBefore(*source_, patch.Vertices());
  if (highest <= rounding) return nullptr;
  const auto [whole, is_new] = buffers_->patches[blocker];
  if (is_new) whole = ViewBlocker(patch.Vertices(), patch);
  if (lowest < -rounding) {
    // If the whole blocker misses the source, so does its part.
    if (!whole.in_limit && whole.cone.size > 0 && Classify(whole.cone, seen) == Overlap::kNone)
      return nullptr;
    const Polygon3 before = ClipToHalfSpace(patch.Vertices(), source_->normal, source_->vertex[0], rounding);
    if (before.empty()) return nullptr;
    return &buffers_->cut.emplace_back(ViewBlocker(before, patch));
  }
  return &whole;
}

PointView::BlockerView PointView::ViewSolid(const ConvexSolid& solid, const Patch* before) const {
  BlockerView view;
  const SolidOutline outline = SeenOutline(at_, solid, before);
  view.entered = outline.entered;
  if (outline.seen.size() <= static_cast<int>(view.cone.normal.size()))
    view.cone = MakeCone(at_, outline.seen, solid.extent);
  return view;
}

// True if the outline of the solid gives what its patches hide. `view` is then the view of the solid's part
// between the point and the source's plane; null if there is none.
bool PointView::FindSolid(SolidId id, const DirectionPolygon& seen, const BlockerView** view) {
  const ConvexSolid& solid = scene_.solids[static_cast<std::size_t>(id)];
  const double rounding = HeightRounding(std::max(solid.extent, source_->extent));
  const auto [lowest, highest] = HeightsBefore(*source_, solid.corners);
  *view = nullptr;
  if (highest <= rounding) return true;
  const auto [whole, is_new] = buffers_->solids[id];
  if (is_new) whole = ViewSolid(solid, nullptr);
  if (whole.cone.size == 0) return false;
  if (whole.entered && lowest <= rounding) return false;
  *view = &whole;
  if (lowest >= -rounding) return true;
  // If the whole solid misses the source, so does its part.
  if (Classify(whole.cone, seen) == Overlap::kNone) {
    *view = nullptr;
    return true;
  }
  *view = &buffers_->cut.emplace_back(ViewSolid(solid, source_));
  return (*view)->cone.size > 0;
}

bool PointView::FindBlockers(std::span<const PatchId> candidates, PatchId own, const DirectionPolygon& seen,
                             std::vector<Occluder>& occluders) {
  const std::size_t before = occluders.size();
  const SolidId own_solid = scene_.SolidOf(own);
  buffers_->as_one.Begin(scene_.solids.size());
  for (const PatchId blocker : candidates) {
    if (blocker == own || &scene_.patches[blocker] == source_) continue;
    const BlockerView* view = nullptr;
    const SolidId solid = scene_.SolidOf(blocker);
    bool as_one = false;
    if (solid != kNoSolid && solid != own_solid && solid != source_solid_) {
      const auto [known, is_new] = buffers_->as_one[solid];
      if (is_new)
        known = FindSolid(solid, seen, &view) ? 1 : 0;
      else if (known != 0)
        continue;
      as_one = known != 0;
    }
    if (!as_one) view = FindBlocker(blocker, seen);
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
