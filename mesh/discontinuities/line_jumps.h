// mesh/discontinuities/line_jumps.h
//
// Jumps of the irradiance's derivatives across a line of a patch. Many discontinuities may lie along one
// line, for example those of the parallel slats of a blind, or of the upright edges of a row of boards. Jumps
// at one place are added with their signs, so that many light discontinuities may have a large sum.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_line.h"

namespace penumbra {

// Sums over all sources: `kink` of first-degree (D1) jumps, `bend` of second-degree (D2) jumps, as
// IrradianceJump times radiosity [W/m^2 ...].
struct LineJump {
  IrradianceJump kink, bend;

  void Add(const LineJump& other);
};

// An estimate [W/m^2] of the error of a quadratic on a piece of the mesh of extent `size` [m] without an edge
// along the line, if the edge would lie at least `margin` [m] from the piece's borders. The terms are those
// of Weight(), except that the largest values are multiplied by sqrt(2 margin / size): where the largest
// values bind, the step ends within the piece, and an edge at its foot frees only the smaller part of the
// piece.
double ErrorWithout(const LineJump& jump, double size, double margin);

class LineJumps {
 public:
  // line_of[i] is the index in `lines` of the line on which found[i] lies. The constructor ignores contacts,
  // which have no jumps.
  LineJumps(std::span<const Discontinuity> found, std::span<const std::int32_t> line_of,
            std::span<const DiscontinuityLine> lines);

  // The sum of jumps across the line at parameter `t` [m]. A D1 event of one source that is found from both
  // ends of the length that its edges share counts once.
  LineJump At(std::int32_t line, double t) const;

 private:
  struct Piece {
    double t0, t1;
    LineJump jump;
  };
  // A tree over the places: each node holds the sum of the jumps that cover the node's whole range. At() adds
  // nodes and never subtracts.
  struct Line {
    std::vector<double> place;  // ends of pieces, ascending
    std::vector<LineJump> node;
  };

  static Line Sum(std::span<const Piece> pieces);

  std::vector<Line> lines_;
};

}  // namespace penumbra
