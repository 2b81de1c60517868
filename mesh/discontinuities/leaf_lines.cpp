#include "mesh/discontinuities/leaf_lines.h"

#include <algorithm>

#include "mesh/discontinuities/leaf_margins.h"
#include "solver/scene/tolerances.h"

namespace penumbra {
namespace {

bool Contains(const std::vector<std::int32_t>& lines, std::int32_t line) {
  return std::find(lines.begin(), lines.end(), line) != lines.end();
}

}  // namespace

Polygon2 LeafOutline(const Element& leaf, const Frame& frame) {
  Polygon2 outline;
  outline.reserve(4);
  for (const Vec3& v : leaf.Vertices()) outline.push_back(frame.ToPlane(v));
  return outline;
}

LeafLines::LeafLines(const ElementForest& forest, PatchId patch, std::size_t most)
    : forest_(forest),
      frame_(PolygonFrame(forest.scene().patches[patch].Vertices())),
      snap_(SnapDistance(forest.scene().patches[patch])),
      most_(most) {
  const ElementId root = ElementForest::Root(patch);
  nodes_.push_back({LeafOutline(forest_[root], frame_)});
  FillNode(0, root);
  touching_.resize(leaves_.size());
  merged_.resize(leaves_.size());
  inside_.resize(leaves_.size());
}

std::span<const Impinged> LeafLines::Meet(const Discontinuity& d) {
  impinged_.clear();
  Descend(0, d.end[0], d.end[1]);
  return impinged_;
}

void LeafLines::Describe(const Discontinuity& d, const LineJumps& jumps, const DirectedLine& line,
                         std::int32_t number, std::span<const double> scale, OmissionCost* cost) {
  cost->Begin();
  const double length = (d.end[1] - d.end[0]).norm();
  const Vec2 along = (d.end[1] - d.end[0]) / length;
  for (const Impinged& i : Meet(d)) {
    if (!i.inside) continue;
    const Polygon2& outline = nodes_[node_of_leaf_[i.leaf]].outline;
    const LineInterval part = ClipLine(d.end[0], along, outline, 0);
    const Vec2 a = d.end[0] + std::max(part.t0, 0.0) * along;
    const Vec2 b = d.end[0] + std::min(part.t1, length) * along;
    const LineJump jump = jumps.At(number, line.Along(0.5 * (a + b)));
    cost->AddPart({i.leaf, a, b, jump}, outline, forest_[leaves_[i.leaf]].area, scale[i.leaf]);
  }
}

bool LeafLines::Full(const Impinged& i, std::int32_t line) const {
  return i.inside && !Contains(inside_[i.leaf], line) && inside_[i.leaf].size() >= most_;
}

bool LeafLines::Crowds(const Discontinuity& d, std::int32_t line) {
  return std::ranges::any_of(Meet(d), [&](const Impinged& i) { return Full(i, line); });
}

void LeafLines::Join(const Impinged& i, std::int32_t line) {
  if (i.inside && !Contains(inside_[i.leaf], line)) inside_[i.leaf].push_back(line);
  std::vector<std::int32_t>& lines = touching_[i.leaf];
  const auto place = static_cast<std::size_t>(std::find(lines.begin(), lines.end(), line) - lines.begin());
  if (place == lines.size()) {
    lines.push_back(line);
    merged_[i.leaf].push_back(0);
  }
  most_merged_ = std::max(most_merged_, ++merged_[i.leaf][place]);
}

void LeafLines::FillNode(std::int32_t index, ElementId id) {
  if (forest_[id].IsLeaf()) {
    nodes_[index].leaf = leaves_.size();
    leaves_.push_back(id);
    node_of_leaf_.push_back(index);
    return;
  }
  const auto first = static_cast<std::int32_t>(nodes_.size());
  nodes_[index].first_child = first;
  const ElementId child = forest_[id].first_child;
  for (ElementId c = child; c < child + 4; ++c) nodes_.push_back({LeafOutline(forest_[c], frame_)});
  for (std::int32_t c = 0; c < 4; ++c) FillNode(first + c, child + c);
}

void LeafLines::Descend(std::int32_t index, const Vec2& a, const Vec2& b) {
  const Node& node = nodes_[index];
  const double length = (b - a).norm();
  const auto meets = [&](double inset) {
    const LineInterval clip = ClipLine(a, (b - a) / length, node.outline, inset);
    return std::max(clip.t0, 0.0) <= std::min(clip.t1, length);
  };
  if (!meets(-kLeafMargin * snap_)) return;
  if (node.first_child < 0) {
    impinged_.push_back({node.leaf, meets(kLeafMargin * snap_)});
    return;
  }
  for (std::int32_t c = 0; c < 4; ++c) Descend(node.first_child + c, a, b);
}

}  // namespace penumbra
