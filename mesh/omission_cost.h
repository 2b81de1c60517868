// mesh/omission_cost.h
//
// What it costs to leave a discontinuity out of a mesh that has others already (thesis 8.2): on the cell of
// the leaf that the active lines leave around it, the error of a quadratic that knows nothing of the jumps
// along its line.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/dset.h"
#include "mesh/line_jumps.h"

namespace penumbra {

class OmissionCost {
 public:
  // Begins the next discontinuity.
  void Begin() { first_part_.push_back(parts_.size()); }
  // The segment ab of it, inside the leaf, with what jumps across its line there.
  void AddPart(std::size_t leaf, const Polygon2& outline, double area, const Vec2& a, const Vec2& b,
               const LineJump& jump);

  // Of leaving out discontinuity i, root mean square over the leaves that it crosses [W/m^2]. It falls when
  // lines become active. `inside` are for each leaf the numbers of those `active` lines that
  // run through it, which only grow from one call to the next; `own` is that of its own line, which does not
  // count; -1 if that is not active.
  double Of(std::size_t i, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
            std::span<const DiscontinuityLine> active);

 private:
  struct Part {
    std::size_t leaf;
    double leaf_area;
    Vec2 middle, across;  // of the segment; a unit vector across it
    LineJump jump;
    Polygon2 cell;          // convex
    std::size_t lines = 0;  // of the leaf that have cut it
  };

  void Cut(Part& part, const DirectedLine& line);

  std::vector<Part> parts_;
  std::vector<std::size_t> first_part_;
  Polygon2 kept_;
};

}  // namespace penumbra
