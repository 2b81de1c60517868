// mesh/discontinuities/leaf_lines.h
//
// Records which discontinuity lines cross which quadtree leaves of a patch, while the patch's discontinuities
// become edges one by one.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/line_jumps.h"
#include "mesh/discontinuities/omission_cost.h"
#include "solver/geometry/polygon.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// The corners of a quadtree leaf in the plane of its patch, counter-clockwise [m].
Polygon2 LeafOutline(const Element& leaf, const Frame& frame);

// A quadtree leaf that a discontinuity meets.
struct Impinged {
  std::size_t leaf;  // index of the leaf in LeafLines::leaves()
  bool inside;       // true if the discontinuity crosses the leaf's interior, not only its border
};

class LeafLines {
 public:
  // At construction, no quadtree leaf has discontinuity lines. At most `most` discontinuity lines may cross
  // the interior of a leaf.
  LeafLines(const ElementForest& forest, PatchId patch, std::size_t most);

  // The quadtree leaves of the patch, depth first.
  std::span<const ElementId> leaves() const { return leaves_; }

  // Returns the quadtree leaves that the discontinuity meets. The result of Meet() is valid until the next
  // call of Meet().
  std::span<const Impinged> Meet(const Discontinuity& d);
  // Adds to the OmissionCost `cost` those segments of the discontinuity that lie in the interior of a
  // quadtree leaf, with the jumps of irradiance across each segment. `number` is the index of the line in the
  // LineJumps `jumps`. In the OmissionCost, errors of irradiance on leaf i are multiplied by scale[i].
  void Describe(const Discontinuity& d, const LineJumps& jumps, const DirectedLine& line, std::int32_t number,
                std::span<const double> scale, OmissionCost* cost);

  // True if the discontinuity line would be a further line through the leaf's interior, but the leaf already
  // has the largest allowed number of discontinuity lines.
  bool Full(const Impinged& i, std::int32_t line) const;
  // True if at least one quadtree leaf that the discontinuity crosses is Full(), so that the line of the
  // discontinuity cannot be added to all leaves. `line` is the number of the discontinuity's line, or -1 if
  // Join() has added the line to no leaf yet.
  bool Crowds(const Discontinuity& d, std::int32_t line);
  // Adds the discontinuity line to the leaf. If the leaf has the discontinuity line already, Join() counts
  // one more discontinuity on the line.
  void Join(const Impinged& i, std::int32_t line);

  // inside()[i] lists the discontinuity lines through the interior of leaf i, in the order of the calls of
  // Join(). touching()[i] lists the discontinuity lines through the interior of leaf i and those along the
  // leaf's border.
  std::span<const std::vector<std::int32_t>> inside() const { return inside_; }
  std::span<const std::vector<std::int32_t>> touching() const { return touching_; }
  // The largest number of discontinuities that Join() has added to one line of one leaf.
  std::size_t most_merged() const { return most_merged_; }

 private:
  struct Node {
    Polygon2 outline;
    std::int32_t first_child = -1;  // index in nodes_ of the node's first child; -1 if the node is a leaf
    std::size_t leaf = 0;           // index of the leaf in leaves_, if the node is a leaf
  };

  void FillNode(std::int32_t index, ElementId id);
  void Descend(std::int32_t index, const Vec2& a, const Vec2& b);

  const ElementForest& forest_;
  Frame frame_;
  double snap_;
  std::size_t most_;
  std::vector<Node> nodes_;  // the nodes of the patch's quadtree, the root first
  std::vector<ElementId> leaves_;
  std::vector<std::int32_t> node_of_leaf_;
  std::vector<std::vector<std::int32_t>> inside_, touching_;
  std::vector<std::vector<std::size_t>> merged_;  // number of discontinuities on each line in touching_[leaf]
  std::size_t most_merged_ = 0;
  std::vector<Impinged> impinged_;
};

}  // namespace penumbra
