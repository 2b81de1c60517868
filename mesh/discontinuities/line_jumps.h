// mesh/discontinuities/line_jumps.h
//
// By how much the derivatives of the irradiance jump across a line of a patch, along which many
// discontinuities may lie: edges of a blind that are all parallel, or the upright edges of a row of boards.
// Jumps in one place add up, with their signs, however light each of them is.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_line.h"

namespace penumbra {

// Sums for what all sources send [W/m^2 ...], of first and of second degree.
struct LineJump {
  IrradianceJump kink, bend;

  void Add(const LineJump& other);
};

// An estimate of the error of a quadratic on a piece of the mesh of the size [m] that has no edge there,
// though it could have one no nearer than `margin` [m] to its borders, as in Weight(), but for the largest
// values: where they bind, a step is over within the piece, and an edge at its foot frees the smaller part of
// the piece, no more [W/m^2].
double ErrorWithout(const LineJump& jump, double size, double margin);

class LineJumps {
 public:
  // `line_of` names for each of `found` the one of `lines` that it lies on. Contacts have no jumps that could
  // be added.
  LineJumps(std::span<const Discontinuity> found, std::span<const std::int32_t> line_of,
            std::span<const DiscontinuityLine> lines);

  // Across a line at the place `t` along it. A D1 event of one source, which is found from either end of the
  // length that its edges share, counts once.
  LineJump At(std::int32_t line, double t) const;

 private:
  struct Piece {
    double t0, t1;
    LineJump jump;
  };
  // What holds on a range of places is kept at the nodes of a tree over the places, so that a sum is a sum of
  // what holds there and nothing has to be subtracted from it.
  struct Line {
    std::vector<double> place;  // where a piece begins or ends, ascending
    std::vector<LineJump> node;
  };

  static Line Sum(std::span<const Piece> pieces);

  std::vector<Line> lines_;
};

}  // namespace penumbra
