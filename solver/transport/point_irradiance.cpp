#include "solver/transport/point_irradiance.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "solver/transport/solution.h"
#include "solver/visibility/point_view.h"

namespace penumbra {
namespace {

using Node = SourceSet::Node;

std::span<const Vec3> Vertices(const Node& node) {
  return {node.vertex.data(), static_cast<std::size_t>(node.size)};
}

// Adds up one source after the other, walking down the source's tree only where shadows fall.
class Gathering {
 public:
  Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at)
      : at_(at), sources_(sources), view_(scene, at), occluders_(view_.occluder_stack()) {}

  void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own) {
    const std::span<const Node> tree = sources_.Tree(source);
    if (tree.empty() || !view_.FaceSource(source)) return;
    const DirectionPolygon seen = view_.SeeSource(Vertices(tree[0]));
    if (seen.empty()) return;
    if (view_.FindBlockers(candidates, own, seen, occluders_)) GatherNode(tree, 0, 0);
    occluders_.clear();
  }

  PointIrradianceResult Result() const { return {irradiance_, view_.one_sided()}; }

 private:
  // Gathers from the subtree at node i; the occluders from `first` to the top of the stack may hide parts of
  // it.
  void GatherNode(std::span<const Node> tree, std::size_t i, std::size_t first_occluder) {
    const Node& node = tree[i];
    const auto skip = static_cast<std::size_t>(node.skip);
    if (first_occluder == occluders_.size()) return GatherVisible(tree.subspan(i, skip));

    // Most nodes lie clear of a shadow's border: a ball around them tells, and the polygon need not be looked
    // at.
    const Vec3 centre = node.centre - at_.position;
    std::optional<DirectionPolygon> seen;
    const std::size_t top = occluders_.size();
    bool hidden = false;
    for (std::size_t c = first_occluder; c < top && !hidden; ++c) {
      Occluder occluder = occluders_[c];
      Overlap overlap = ClassifyBall(occluder, centre, node.radius);
      if (overlap == Overlap::kPart) {
        if (!seen) seen = view_.SeeSource(Vertices(node));
        if (seen->empty()) break;
        overlap = Classify(occluder, *seen);
      }
      hidden = overlap == Overlap::kAll;
      if (overlap == Overlap::kPart) occluders_.push_back(occluder);
    }
    hidden = hidden || (seen && seen->empty());
    if (!hidden) {
      if (occluders_.size() == top) {
        GatherVisible(tree.subspan(i, skip));
      } else if (skip == 1) {
        irradiance_ += view_.VisibleFormFactor(*seen, std::span(occluders_).subspan(top)) * node.radiosity;
      } else {
        for (std::size_t child = i + 1; child < i + skip; child += static_cast<std::size_t>(tree[child].skip))
          GatherNode(tree, child, top);
      }
    }
    occluders_.resize(top);
  }

  // Adds all leaves of a subtree that nothing hides.
  void GatherVisible(std::span<const Node> nodes) {
    if (!view_.SourceIsPlain()) {
      for (const Node& node : nodes)
        if (node.skip == 1)
          irradiance_ += view_.VisibleFormFactor(view_.SeeSource(Vertices(node)), {}) * node.radiosity;
      return;
    }
    constexpr std::size_t kBatch = 128;
    std::array<double, kBatch> factor;
    const auto first = static_cast<std::size_t>(nodes[0].first_leaf);
    const auto end = first + static_cast<std::size_t>(nodes[0].leaf_count);
    const std::span<const Rgb> radiosity = sources_.LeafRadiosities();
    for (std::size_t begin = first; begin < end; begin += kBatch) {
      const std::size_t stop = std::min(end, begin + kBatch);
      FormFactors(sources_.LeafPolygons(), begin, stop, at_.position, at_.normal, factor.data());
      for (std::size_t i = begin; i < stop; ++i) irradiance_ += factor[i - begin] * radiosity[i];
    }
  }

  const ReceiverPoint& at_;
  const SourceSet& sources_;
  PointView view_;
  std::vector<Occluder>& occluders_;  // a stack: what may still hide the node at hand
  Rgb irradiance_ = Rgb::Zero();
};

}  // namespace

PointIrradiance::PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility)
    : scene_(solution.forest.scene()),
      visibility_(visibility),
      forest_(&solution.forest),
      sources_(SourceSet::FromSolution(solution)),
      leaves_(solution.forest, visibility),
      all_patches_(scene_.patches.size()) {
  std::iota(all_patches_.begin(), all_patches_.end(), 0);
}

PointIrradiance::PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources)
    : scene_(scene),
      visibility_(visibility),
      sources_(std::move(sources)),
      all_patches_(scene.patches.size()) {
  std::iota(all_patches_.begin(), all_patches_.end(), 0);
}

PointIrradianceResult PointIrradiance::OnPatch(PatchId patch, const ReceiverPoint& at) const {
  Gathering gathering(scene_, sources_, at);
  if (forest_ != nullptr) {
    for (const PatchPair& pair : leaves_.SourcesOf(forest_->LeafAt(patch, at.position)))
      gathering.AddSource(pair.source, leaves_.Blockers(pair), patch);
  } else {
    for (const PatchPair& pair : visibility_.SourcesOf(patch))
      gathering.AddSource(pair.source, visibility_.Blockers(pair), patch);
  }
  return gathering.Result();
}

PointIrradianceResult PointIrradiance::Anywhere(const ReceiverPoint& at) const {
  Gathering gathering(scene_, sources_, at);
  for (const PatchId source : all_patches_) gathering.AddSource(source, all_patches_, kNoPatch);
  return gathering.Result();
}

}  // namespace penumbra
