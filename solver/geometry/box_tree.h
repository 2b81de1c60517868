// solver/geometry/box_tree.h
//
// Boxes in the plane, found by where they lie: for the many edges of a large outline.

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
  // Builds the tree anew, in time n log n.
  void Build(std::span<const PlaneBox> boxes);

  // The indices of the boxes that meet this one, in no order, go to `found`.
  void Find(const PlaneBox& box, std::vector<std::int32_t>& found) const;

 private:
  struct Node {
    PlaneBox box;                       // around all of its boxes
    std::int32_t first = 0, count = 0;  // of a leaf: its range in order_; else count is 0
    std::int32_t second = 0;            // the second child; the first one follows its parent
  };

  std::int32_t BuildNode(std::int32_t first, std::int32_t count);

  std::span<const PlaneBox> given_;  // while it is built
  std::vector<PlaneBox> boxes_;      // in the order of order_
  std::vector<std::int32_t> order_;
  std::vector<Node> nodes_;
  mutable std::vector<std::int32_t> stack_;
};

}  // namespace penumbra
