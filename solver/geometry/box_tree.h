// solver/geometry/box_tree.h
//
// A bounding box hierarchy over axis-aligned boxes in the plane, for the edges of large outlines.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct PlaneBox {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();

  bool Meets(const PlaneBox& other) const {
    return (low.array() <= other.high.array()).all() && (other.low.array() <= high.array()).all();
  }
};

class BoxTree {
 public:
  // Builds a new tree over n boxes, in time O(n log n).
  void Build(std::span<const PlaneBox> boxes);

  // Sets `found` to the indices of the boxes that intersect `box`, in unspecified order.
  void Find(const PlaneBox& box, std::vector<std::int32_t>& found) const;

 private:
  struct Node {
    PlaneBox box;  // the bounding box of all boxes below this tree node
    // The boxes of a leaf of the tree are the entries `first` to `first + count - 1` of order_; `count` is 0
    // in an inner node of the tree.
    std::int32_t first = 0, count = 0;
    // Index of the node's second child; the first child is stored directly after its parent.
    std::int32_t second = 0;
  };

  std::int32_t BuildNode(std::int32_t first, std::int32_t count);

  std::span<const PlaneBox> given_;  // the boxes that were passed to Build(); valid only during Build()
  std::vector<PlaneBox> boxes_;      // boxes_[i] is the box that Build() was given at index order_[i]
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
  mutable std::vector<std::int32_t> stack_;
};

}  // namespace penumbra
