// mesh/discontinuities/line_jumps.h
//
// Jumps of the irradiance's derivatives across a line of a patch. Many discontinuities may lie along one
// line, for example those of the parallel slats of a blind, or of the vertical edges of a row of boards.
// Signed jumps at the same place are added up; many discontinuities of small weight may therefore have a
// large sum.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_line.h"

namespace penumbra {

// Sums over all sources of IrradianceJump * radiosity: `kink` is the sum for D1 discontinuities, `bend` the
// sum for D2 discontinuities.
struct LineJump {
  IrradianceJump kink, bend;

  void Add(const LineJump& other);
};

// An estimate [W/m^2] of the error of a quadratic interpolant on a piece of the mesh that has no edge along
// the line. `size` [m] is the extent of the piece; `margin` [m] is the smallest distance of the line from the
// piece's borders. The formula is that of Weight() with kIrradiance, except that largest_value is multiplied
// by sqrt(2 margin / size): where largest_value is the smallest term, the change of the irradiance ends
// within the piece, and an edge along the line improves only the smaller part of the piece.
double ErrorWithout(const LineJump& jump, double size, double margin);

class LineJumps {
 public:
  // line_of[i] is the index in `lines` of the line on which found[i] lies. Contacts, which have no jumps, are
  // ignored.
  LineJumps(std::span<const Discontinuity> found, std::span<const std::int32_t> line_of,
            std::span<const DiscontinuityLine> lines);

  // The sum of the jumps across the line at parameter `t` [m]. If the same D1 event of a source was found
  // twice, from both ends of the segment in which the two coplanar edges overlap, it is counted once.
  LineJump At(std::int32_t line, double t) const;

 private:
  struct Piece {
    double t0, t1;
    LineJump jump;
  };
  // A segment tree over the ends of pieces: each node holds the sum of the jumps that cover the node's whole
  // range. At() adds up nodes and never subtracts, so that no rounding errors remain from jumps elsewhere.
  struct Line {
    std::vector<double> place;  // ends of pieces, ascending
    std::vector<LineJump> node;
  };

  static Line Sum(std::span<const Piece> pieces);

  std::vector<Line> lines_;
};

}  // namespace penumbra
