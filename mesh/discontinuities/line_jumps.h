// mesh/discontinuities/line_jumps.h
//
// Jumps of the irradiance's derivatives across a line on a patch. Many discontinuities may lie along one
// line, for example those of the parallel slats of a blind, or of the vertical edges of a row of boards.
// Signed jumps of derivatives at the same place are added up, so that many discontinuities of small weight
// may have a large sum.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_line.h"

namespace penumbra {

// Sums of IrradianceJump * radiosity over all sources: `kink` is the sum for D1 discontinuities (jumps of the
// first derivative), `bend` the sum for D2 discontinuities.
struct LineJump {
  IrradianceJump kink, bend;

  void Add(const LineJump& other);
};

// Returns an estimate [W/m^2] of the error of a quadratic interpolant on a piece of the mesh that a
// discontinuity line crosses without an edge along the line. `size` [m] is the extent of the piece of the
// mesh across the line. `margin` [m] is the smallest distance of the line from the borders of the piece of
// the mesh. The error estimate is that of Weight() with kIrradiance, except that largest_value (bound of the
// change of the irradiance) is multiplied by sqrt(2 margin / size). The line cuts the piece into two parts,
// and an edge along the line improves the interpolant mainly on the smaller part, whose area is (margin /
// size) * (area of the piece). The factor sqrt(2 margin / size) is 1 for a line through the middle of the
// piece of the mesh.
double ErrorWithout(const LineJump& jump, double size, double margin);

class LineJumps {
 public:
  // line_of[i] is the index in `lines` of the line on which the discontinuity found[i] lies. Contacts with
  // other surfaces are ignored, because the irradiance itself jumps there.
  LineJumps(std::span<const Discontinuity> found, std::span<const std::int32_t> line_of,
            std::span<const DiscontinuityLine> lines);

  // Returns the sum of the jumps of derivatives across the line at parameter `t` [m]. The same D1 event of a
  // source may have been found twice, from both ends of the segment in which a source edge and a coplanar
  // blocker edge overlap as seen from the line. At() counts a D1 event (jump of the first derivative) only
  // once, even if the event was found twice.
  LineJump At(std::int32_t line, double t) const;

 private:
  struct Piece {
    double t0, t1;
    LineJump jump;
  };
  // A segment tree over a line: each node of the tree stands for an interval of the line, and holds the sum
  // of the jumps on pieces that cover the whole interval. At() adds up nodes of the segment tree and never
  // subtracts, so that no rounding errors remain from jumps elsewhere.
  struct Line {
    std::vector<double> place;  // parameters at which pieces of the line begin or end, ascending [m]
    std::vector<LineJump> node;
  };

  static Line Sum(std::span<const Piece> pieces);

  std::vector<Line> lines_;
};

}  // namespace penumbra
