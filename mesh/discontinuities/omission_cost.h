// mesh/discontinuities/omission_cost.h
//
// The cost of omission: the error that arises if a discontinuity is no edge of a mesh that already has other
// edges (thesis 8.2). In a quadtree leaf, the lines that are already edges of the mesh bound a cell (convex
// part of the leaf) around the discontinuity. The cost of omission is the error of a quadratic interpolant on
// the cell around the discontinuity, if the interpolant does not follow the jumps across the discontinuity.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity_line.h"
#include "mesh/discontinuities/line_jumps.h"

namespace penumbra {

// A segment of a discontinuity inside a quadtree leaf, with the jumps of irradiance across the segment.
struct OmittedPart {
  std::size_t leaf = 0;
  Vec2 from = Vec2::Zero(), to = Vec2::Zero();  // end points of the segment, in the frame of the patch [m]
  LineJump jump;
};

// Returns the error estimate ErrorWithout() for the jumps of the segment `part` on a convex piece of the mesh
// that the segment crosses [W/m^2].
double ErrorOnPiece(const OmittedPart& part, std::span<const Vec2> piece);

class OmissionCost {
 public:
  // Starts a new discontinuity, to which subsequent calls of AddPart() add segments.
  void Begin() { first_part_.push_back(parts_.size()); }
  // Adds a segment of the current discontinuity, in a quadtree leaf with the outline `outline` and the area
  // `area` [m^2]. In the cost of omission, errors of irradiance on the leaf are multiplied by the factor
  // `scale`.
  void AddPart(const OmittedPart& part, const Polygon2& outline, double area, double scale) {
    parts_.push_back({part, area, scale, scale, outline, 0});
  }

  // For every segment, sets the factor by which errors of irradiance are multiplied to scale(segment, f),
  // where f is the factor that AddPart() has set.
  void Rescale(const std::function<double(const OmittedPart&, double)>& scale) {
    for (Part& part : parts_) part.scale = scale(part.segment, part.leaf_scale);
  }

  // In calls of Of() and PartsWithout(), inside[k] holds the indices of those lines in `active` that cross
  // quadtree leaf k. Between two calls of members of OmissionCost, lines may be added to inside[k] but not
  // removed. `own` is the number of the line on which the discontinuity itself lies, or -1 if this line is no
  // edge of the mesh. The line of the discontinuity itself does not bound the cell on which the cost of
  // omission is measured.

  struct Cost {
    // The cost of omission if errors of irradiance are multiplied by the factors that Rescale() sets [W/m^2].
    double by_place = 0;
    // The cost of omission if errors of irradiance are multiplied by the larger of the two factors that
    // AddPart() and Rescale() set [W/m^2].
    double at_most = 0;
  };

  // The cost of omitting discontinuity i: the root mean square, over the area of the leaves that the
  // discontinuity crosses, of the error without an edge along the discontinuity [W/m^2]. The costs by_place
  // and at_most decrease as more lines become edges of the mesh.
  Cost Of(std::size_t i, std::int32_t own, std::span<const std::vector<std::int32_t>> inside,
          std::span<const DiscontinuityLine> active);
  // The number of quadtree leaves whose interior discontinuity i crosses.
  std::size_t LeavesOf(std::size_t i) { return PartsOf(i).size(); }
  // Returns the segments of discontinuity i in those leaves that have no edge along its line, and where the
  // error without this edge, multiplied by the factor of the last Rescale() (without Rescale(): of
  // AddPart()), is at least `least` [W/m^2].
  std::vector<OmittedPart> PartsWithout(std::size_t i, std::int32_t own,
                                        std::span<const std::vector<std::int32_t>> inside,
                                        std::span<const DiscontinuityLine> active, double least);

 private:
  struct Part {
    OmittedPart segment;
    double leaf_area, leaf_scale, scale;
    Polygon2 cell;          // convex part of the quadtree leaf around the segment
    std::size_t lines = 0;  // number of the leaf's discontinuity lines by which `cell` has been cut so far
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
