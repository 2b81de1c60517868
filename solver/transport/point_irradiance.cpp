#include "solver/transport/point_irradiance.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "solver/visibility/direction_polygon.h"

namespace penumbra {
namespace {

using Node = SourceSet::Node;

std::span<const Vec3> Vertices(const Node& node) { return {node.vertex.data(), static_cast<std::size_t>(node.size)}; }

// What does not depend on the point: bounds of coordinates for the tests of sides.
double Extent(const Patch& patch) {
  double extent = 0;
  for (const Vec3& v : patch.Vertices()) extent = std::max(extent, MaxAbs(v));
  return extent;
}

// How one patch looks as a blocker from one point.
struct BlockerView {
  bool in_limit = false;
  Cone cone;  // size 0: it blocks nothing
};

// The blockers seen from the point at hand, made when first asked for.
struct Scratch {
  std::vector<std::uint32_t> stamp;
  std::vector<BlockerView> view;
  std::uint32_t now = 0;
  std::vector<BlockerView> clipped;          // blockers cut at a source's plane
  std::vector<const Cone*> cones;            // a stack: what may still hide the node at hand
  std::vector<DirectionPolygon> pieces;

  void Begin(std::size_t patches) {
    if (stamp.size() != patches) {
      stamp.assign(patches, 0);
      view.resize(patches);
      now = 0;
    }
    if (++now == 0) {
      std::fill(stamp.begin(), stamp.end(), 0);
      now = 1;
    }
  }
};

Scratch& ThreadScratch(std::size_t patches) {
  thread_local Scratch scratch;
  scratch.Begin(patches);
  return scratch;
}

}  // namespace

struct PointIrradiance::Impl {
  const Scene& scene;
  const PatchVisibility& visibility;
  const SourceSet& sources;
  std::vector<double> extent;
  std::vector<PatchId> all;

  // One call: the point, what has been gathered so far, and where to work.
  class Gathering {
   public:
    Gathering(const Impl& impl, const ReceiverPoint& point);
    void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own);
    const PointIrradianceResult& result() const { return result_; }

   private:
    BlockerView View(std::span<const Vec3> polygon, const Patch& patch, double extent) const;
    const BlockerView* FindBlocker(PatchId blocker, const Patch& source, double extent);
    DirectionPolygon SeenNode(const Node& node) const;
    void GatherNode(std::span<const Node> tree, std::size_t i, std::size_t first_cone);
    void GatherLeaf(const Node& leaf, const DirectionPolygon& seen, std::size_t first_cone);
    void GatherVisible(std::span<const Node> leaves);

    const Impl& impl_;
    const ReceiverPoint& at_;
    Scratch& scratch_;
    PointIrradianceResult result_;
    bool source_in_contact_ = false;  // of the source at hand
    bool source_crosses_horizon_ = false;
  };
};

BlockerView PointIrradiance::Impl::Gathering::View(std::span<const Vec3> polygon, const Patch& patch,
                                                   double extent) const {
  BlockerView view;
  const Side side = SideOf(at_, patch.normal, patch.vertex[0], extent);
  if (side == Side::kInPlane) return view;
  const bool from_front = side == Side::kFront || side == Side::kFrontInLimit;
  view.in_limit = side == Side::kFrontInLimit || side == Side::kBackInLimit;
  view.cone = MakeCone(view.in_limit ? SeenInContact(at_, polygon, from_front) : Seen(at_, polygon, from_front));
  return view;
}

// The blocker's part strictly between the point and the source's plane, as seen; null if it has none.
const BlockerView* PointIrradiance::Impl::Gathering::FindBlocker(PatchId blocker, const Patch& source,
                                                                 double extent) {
  const Patch& patch = impl_.scene.patches[blocker];
  const double rounding = HeightRounding(extent);
  double lowest = 0, highest = 0;
  for (const Vec3& v : patch.Vertices()) {
    const double height = source.normal.dot(v - source.vertex[0]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= rounding) return nullptr;
  if (lowest < -rounding) {
    const Polygon3 before = ClipToHalfSpace(patch.Vertices(), source.normal, source.vertex[0]);
    if (before.empty()) return nullptr;
    scratch_.clipped.push_back(View(before, patch, extent));
    return &scratch_.clipped.back();
  }
  if (scratch_.stamp[blocker] != scratch_.now) {
    scratch_.stamp[blocker] = scratch_.now;
    scratch_.view[blocker] = View(patch.Vertices(), patch, impl_.extent[blocker]);
  }
  return &scratch_.view[blocker];
}

void PointIrradiance::Impl::Gathering::AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own) {
  const std::span<const Node> tree = impl_.sources.Tree(source);
  if (tree.empty()) return;
  const Patch& patch = impl_.scene.patches[source];
  const Side side = SideOf(at_, patch.normal, patch.vertex[0], impl_.extent[source]);
  if (side != Side::kFront && side != Side::kFrontInLimit) return;
  source_in_contact_ = side == Side::kFrontInLimit;

  DirectionPolygon seen = SeenNode(tree[0]);
  double lowest = 0, highest = 0;
  for (int i = 0; i < seen.size(); ++i) {
    const double height = at_.normal.dot(seen[i]);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (highest <= 0) return;
  source_crosses_horizon_ = lowest < 0;
  if (source_crosses_horizon_) seen = ClipToHorizon(seen, at_.normal);
  if (source_in_contact_) result_.one_sided = true;

  scratch_.cones.clear();
  scratch_.clipped.clear();
  scratch_.clipped.reserve(candidates.size());  // the stack keeps pointers into it
  for (const PatchId blocker : candidates) {
    if (blocker == source || blocker == own) continue;
    const BlockerView* view =
        FindBlocker(blocker, patch, std::max(impl_.extent[source], impl_.extent[blocker]));
    if (!view || view->cone.size == 0) continue;
    const Overlap overlap = Classify(view->cone, seen);
    if (overlap == Overlap::kNone) continue;
    if (view->in_limit) result_.one_sided = true;
    if (overlap == Overlap::kAll) return;
    scratch_.cones.push_back(&view->cone);
  }
  GatherNode(tree, 0, 0);
}

DirectionPolygon PointIrradiance::Impl::Gathering::SeenNode(const Node& node) const {
  return source_in_contact_ ? SeenInContact(at_, Vertices(node), true) : Seen(at_, Vertices(node), true);
}

// Gathers from the subtree at node i; the cones from `first_cone` to the top of the stack may hide parts of it.
void PointIrradiance::Impl::Gathering::GatherNode(std::span<const Node> tree, std::size_t i, std::size_t first_cone) {
  const Node& node = tree[i];
  const auto skip = static_cast<std::size_t>(node.skip);
  if (first_cone == scratch_.cones.size()) return GatherVisible(tree.subspan(i, skip));

  DirectionPolygon seen = SeenNode(node);
  if (source_crosses_horizon_) seen = ClipToHorizon(seen, at_.normal);
  if (seen.empty()) return;
  const std::size_t top = scratch_.cones.size();
  bool hidden = false;
  for (std::size_t c = first_cone; c < top && !hidden; ++c) {
    const Cone* cone = scratch_.cones[c];
    const Overlap overlap = Classify(*cone, seen);
    hidden = overlap == Overlap::kAll;
    if (overlap == Overlap::kPart) scratch_.cones.push_back(cone);
  }
  if (!hidden) {
    if (scratch_.cones.size() == top) {
      GatherVisible(tree.subspan(i, skip));
    } else if (skip == 1) {
      GatherLeaf(node, seen, top);
    } else {
      for (std::size_t child = i + 1; child < i + skip; child += static_cast<std::size_t>(tree[child].skip))
        GatherNode(tree, child, top);
    }
  }
  scratch_.cones.resize(top);
}

void PointIrradiance::Impl::Gathering::GatherLeaf(const Node& leaf, const DirectionPolygon& seen,
                                                  std::size_t first_cone) {
  scratch_.pieces.assign(1, seen);
  for (std::size_t c = first_cone; c < scratch_.cones.size() && !scratch_.pieces.empty(); ++c)
    Subtract(*scratch_.cones[c], scratch_.pieces);
  double factor = 0;
  for (const DirectionPolygon& piece : scratch_.pieces) factor += FormFactor(piece, at_.normal);
  result_.irradiance += factor * leaf.radiosity;
}

void PointIrradiance::Impl::Gathering::GatherVisible(std::span<const Node> leaves) {
  for (const Node& leaf : leaves) {
    if (leaf.skip != 1) continue;
    DirectionPolygon seen = SeenNode(leaf);
    if (source_crosses_horizon_) seen = ClipToHorizon(seen, at_.normal);
    result_.irradiance += FormFactor(seen, at_.normal) * leaf.radiosity;
  }
}

PointIrradiance::Impl::Gathering::Gathering(const Impl& impl, const ReceiverPoint& point)
    : impl_(impl), at_(point), scratch_(ThreadScratch(impl.all.size())) {}

PointIrradiance::PointIrradiance(const Scene& scene, const PatchVisibility& visibility, const SourceSet& sources)
    : impl_(new Impl{scene, visibility, sources, {}, {}}) {
  for (const Patch& patch : scene.patches) impl_->extent.push_back(Extent(patch));
  impl_->all.resize(scene.patches.size());
  std::iota(impl_->all.begin(), impl_->all.end(), 0);
}

PointIrradiance::~PointIrradiance() = default;
PointIrradiance::PointIrradiance(PointIrradiance&&) noexcept = default;

PointIrradianceResult PointIrradiance::OnPatch(PatchId patch, const ReceiverPoint& at) const {
  Impl::Gathering gathering(*impl_, at);
  for (const PatchPair& pair : impl_->visibility.SourcesOf(patch))
    gathering.AddSource(pair.source, impl_->visibility.Blockers(pair), patch);
  return gathering.result();
}

PointIrradianceResult PointIrradiance::Anywhere(const ReceiverPoint& at) const {
  Impl::Gathering gathering(*impl_, at);
  for (const PatchId source : impl_->all) gathering.AddSource(source, impl_->all, kNoPatch);
  return gathering.result();
}

}  // namespace penumbra
