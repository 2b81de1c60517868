// mesh/discontinuities/leaf_lines.h
//
// Which lines run through which leaves of a patch, while its discontinuities are activated one by one.

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

// A leaf's corners in the plane of its patch, counter-clockwise.
Polygon2 LeafOutline(const Element& leaf, const Frame& frame);

// A leaf on which a discontinuity impinges.
struct Impinged {
  std::size_t leaf;  // its place among LeafLines::leaves()
  bool inside;       // it crosses the leaf's inside, not just its border
};

class LeafLines {
 public:
  // No lines yet. No leaf will take more than `most` through its inside.
  LeafLines(const ElementForest& forest, PatchId patch, std::size_t most);

  // Depth first.
  std::span<const ElementId> leaves() const { return leaves_; }

  // The leaves that the discontinuity meets, until the next call.
  std::span<const Impinged> Meet(const Discontinuity& d);
  // Tells what leaving it out costs where it crosses the inside of a leaf. `number` is that of its line among
  // those of the jumps; on each leaf errors count `scale` times.
  void Describe(const Discontinuity& d, const LineJumps& jumps, const DirectedLine& line, std::int32_t number,
                std::span<const double> scale, OmissionCost* cost);

  // True if the leaf has no room for the line.
  bool Full(const Impinged& i, std::int32_t line) const;
  // True if one of the leaves that the discontinuity crosses has no room for its line; -1 if no leaf has it.
  bool Crowds(const Discontinuity& d, std::int32_t line);
  // Makes the line one of the leaf's, for one discontinuity more.
  void Join(const Impinged& i, std::int32_t line);

  // Per leaf, the lines that run through its inside, and those that run along its border, too; in the order
  // in which they came.
  std::span<const std::vector<std::int32_t>> inside() const { return inside_; }
  std::span<const std::vector<std::int32_t>> touching() const { return touching_; }
  // The most discontinuities of one line in one leaf.
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
