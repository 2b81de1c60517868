#include "solver/geometry/box_tree.h"

#include <algorithm>
#include <numeric>

#include "solver/base/size.h"

namespace penumbra {

void BoxTree::Build(std::span<const PlaneBox> boxes) {
  given_ = boxes;
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.clear();
  if (!boxes.empty()) BuildNode(0, Size(boxes));
  boxes_.clear();
  for (const std::int32_t i : order_) boxes_.push_back(boxes[i]);
}

// Halves the boxes by their middles along the longer side; returns the node.
std::int32_t BoxTree::BuildNode(std::int32_t first, std::int32_t count) {
  constexpr std::int32_t kLeaf = 8;
  const std::int32_t index = Size(nodes_);
  Node node;
  node.box = given_[order_[first]];
  for (std::int32_t i = first; i < first + count; ++i) {
    node.box.low = node.box.low.cwiseMin(given_[order_[i]].low);
    node.box.high = node.box.high.cwiseMax(given_[order_[i]].high);
  }
  nodes_.push_back(node);
  if (count <= kLeaf) {
    nodes_[index].first = first;
    nodes_[index].count = count;
    return index;
  }
  const Vec2 side = node.box.high - node.box.low;
  const int axis = side.x() >= side.y() ? 0 : 1;
  const auto middle = [&](std::int32_t i) { return given_[i].low[axis] + given_[i].high[axis]; };
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::int32_t a, std::int32_t b) {
    const double ma = middle(a), mb = middle(b);
    return ma != mb ? ma < mb : a < b;
  });
  BuildNode(first, count / 2);
  const std::int32_t second = BuildNode(first + count / 2, count - count / 2);
  nodes_[index].second = second;
  return index;
}

void BoxTree::Find(const PlaneBox& box, std::vector<std::int32_t>& found) const {
  found.clear();
  stack_.clear();
  if (!nodes_.empty()) stack_.push_back(0);
  while (!stack_.empty()) {
    const std::int32_t index = stack_.back();
    stack_.pop_back();
    const Node& node = nodes_[index];
    if (!node.box.Meets(box)) continue;
    if (node.count == 0) {
      stack_.push_back(node.second);
      stack_.push_back(index + 1);
    }
    for (std::int32_t i = node.first; i < node.first + node.count; ++i)
      if (boxes_[i].Meets(box)) found.push_back(order_[i]);
  }
}

}  // namespace penumbra
