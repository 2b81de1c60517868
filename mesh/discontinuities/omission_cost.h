// mesh/discontinuities/omission_cost.h
//
// The cost of omitting a discontinuity from a mesh that already has other edges (thesis 8.2). The active
// lines of a leaf bound a cell around the discontinuity. The cost is the error, on the cell around the
// discontinuity, of a quadratic interpolant that does not follow the jumps along the discontinuity's line.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity_line.h"
#include "mesh/discontinuities/line_jumps.h"

namespace penumbra {

// A segment of a discontinuity inside a leaf, with the jumps across the segment.
struct OmittedPart {
  std::size_t leaf = 0;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  // in the frame of the patch [m]
  LineJump jump;
};

// The result of ErrorWithout() for the segment's jumps on a convex piece of the mesh that the segment crosses
// [W/m^2].
double ErrorOnPiece(const OmittedPart& part, std::span<const Vec2> piece);

class OmissionCost {
 public:
  // Starts a new discontinuity, to which subsequent calls of AddPart() add parts.
  void Begin() { first_part_.push_back(parts_.size()); }
  // Adds a part of the current discontinuity, in a leaf with this outline and this area [m^2]. Errors on the
  // leaf are multiplied by `scale`.
  void AddPart(const OmittedPart& part, const Polygon2& outline, double area, double scale) {
    parts_.push_back({part, area, scale, scale, outline, 0});
  }

  // Sets the error factor of every part to scale(part, error factor of the part's leaf).
  void Rescale(const std::function<double(const OmittedPart&, double)>& scale) {
    for (Part& part : parts_) part.scale = scale(part.segment, part.leaf_scale);
  }

  // In the functions below, inside[k] holds the numbers of those lines of `active` that cross leaf k; between
  // calls, lines may be added but not removed. `own` is the number of the discontinuity's own line, by which
  // cells are not cut; -1 if this line is not active.

  struct Cost {
    double by_place = 0;  // with the factors of Rescale() [W/m^2]
    double at_most = 0;   // with the larger of the part's and the leaf's factors [W/m^2]
  };

  // The cost of omitting discontinuity i: the root mean square of the errors on the leaves that it crosses
  // [W/m^2]. The costs by_place and at_most decrease as more lines become active.
  Cost Of(std::size_t i, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
          std::span<const DiscontinuityLine> active);
  // The number of leaves whose interior discontinuity i crosses.
  std::size_t LeavesOf(std::size_t i) { return PartsOf(i).size(); }
  // The parts of discontinuity i in leaves that are not crossed by its line, if the cost of omission on the
  // leaf is at least `least` [W/m^2].
  std::vector<OmittedPart> PartsWithout(std::size_t i, std::int32_t own,
                                        std::span<const std::vector<std::int32_t>> inside,
                                        std::span<const DiscontinuityLine> active, double least);

 private:
  struct Part {
    OmittedPart segment;
    double leaf_area, leaf_scale, scale;
    Polygon2 cell;          // convex
    std::size_t lines = 0;  // number of the leaf's lines that have cut the cell
  };

  std::span<Part> PartsOf(std::size_t i);
  void CutByLines(Part& part, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
                  std::span<const DiscontinuityLine> active);
  void Cut(Part& part, const DirectedLine& line);

  std::vector<Part> parts_;
  std::vector<std::size_t> first_part_;
  Polygon2 kept_;
};

}  // namespace penumbra
