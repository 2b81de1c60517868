// display/contour_lines.h

#pragma once

#include <array>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Values on a regular grid, stored as values[row * columns + column]; grid points without a value hold nan.
struct ValueGrid {
  int columns = 0, rows = 0;
  std::vector<double> values;

  double At(int column, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
};

// The contour lines of a grid at the value `level`, as segments between points (column, row). Values are
// interpolated linearly between neighbouring grid points. Grid squares with a corner without a value get no
// contour line. If two contour lines cross a grid square, the mean of the square's corner values decides how
// the lines pass the centre (marching squares, Lorensen and Cline 1987 in two dimensions).
std::vector<std::array<Vec2, 2>> ContourLines(const ValueGrid& grid, double level);

}  // namespace penumbra
