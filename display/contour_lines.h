// display/contour_lines.h

#pragma once

#include <array>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// Values on a regular grid: value [row * columns + column]; nan where there is none.
struct ValueGrid {
  int columns = 0, rows = 0;
  std::vector<double> values;

  double At(int column, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
  }
};

// The places where the values, linear between neighbours, equal `level`: segments between points (column,
// row). Squares without a value at a corner are left out. The mean of a square's corners decides how two
// lines pass its middle (marching squares, Lorensen and Cline 1987 in two dimensions).
std::vector<std::array<Vec2, 2>> ContourLines(const ValueGrid& grid, double level);

}  // namespace penumbra
