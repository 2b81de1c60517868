// mesh/discontinuities/leaf_lines.h
//
// The lines that cross the leaves of a patch, while the patch's discontinuities are activated one by one.

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

// The corners of a leaf in the plane of its patch, counter-clockwise [m].
Polygon2 LeafOutline(const Element& leaf, const Frame& frame);

// A leaf on which a discontinuity impinges.
struct Impinged {
  std::size_t leaf;  // index in LeafLines::leaves()
  bool inside;       // the discontinuity crosses the leaf's interior, not only its border
};

class LeafLines {
 public:
  // Starts without lines. No leaf takes more than `most` lines through its interior.
  LeafLines(const ElementForest& forest, PatchId patch, std::size_t most);

  // The leaves of the patch, depth first.
  std::span<const ElementId> leaves() const { return leaves_; }

  // The leaves that the discontinuity meets. The result is valid until the next call.
  std::span<const Impinged> Meet(const Discontinuity& d);
  // Adds to `cost` the parts of the discontinuity in the interiors of leaves, with their jumps. `number` is
  // the index of `line` in `jumps`; scale[i] multiplies the errors on leaf i.
  void Describe(const Discontinuity& d, const LineJumps& jumps, const DirectedLine& line, std::int32_t number,
                std::span<const double> scale, OmissionCost* cost);

  // True if the line would cross the leaf's interior and the leaf has no room for it.
  bool Full(const Impinged& i, std::int32_t line) const;
  // True if a leaf that the discontinuity crosses has no room for its line. `line` is -1 if no leaf has the
  // line.
  bool Crowds(const Discontinuity& d, std::int32_t line);
  // Adds the line to the leaf, for one more discontinuity.
  void Join(const Impinged& i, std::int32_t line);

  // Per leaf, in the order of Join(): the lines through the interior; and these together with the lines along
  // the border.
  std::span<const std::vector<std::int32_t>> inside() const { return inside_; }
  std::span<const std::vector<std::int32_t>> touching() const { return touching_; }
  // The largest number of discontinuities that joined one line of one leaf.
  std::size_t most_merged() const { return most_merged_; }

 private:
  struct Node {
    Polygon2 outline;
    std::int32_t first_child = -1;  // in nodes_; -1: a leaf
    std::size_t leaf = 0;           // index in leaves_
  };

  void FillNode(std::int32_t index, ElementId id);
  void Descend(std::int32_t index, const Vec2& a, const Vec2& b);

  const ElementForest& forest_;
  Frame frame_;
  double snap_;
  std::size_t most_;
  std::vector<Node> nodes_;  // the root first
  std::vector<ElementId> leaves_;
  std::vector<std::int32_t> node_of_leaf_;
  std::vector<std::vector<std::int32_t>> inside_, touching_;
  std::vector<std::vector<std::size_t>> merged_;  // discontinuities of each line of touching_
  std::size_t most_merged_ = 0;
  std::vector<Impinged> impinged_;
};

}  // namespace penumbra
