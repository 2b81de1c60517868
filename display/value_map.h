// display/value_map.h
//
// A drawing of values on a horizontal grid: false colours, contour lines at round values, a scale, and axes
// in metres.

#pragma once

#include <string>

#include "display/contour_lines.h"
#include "solver/geometry/vec.h"

namespace penumbra {

struct ValueMap {
  ValueGrid grid;             // values of 0 or more
  Vec2 first = Vec2::Zero();  // x and y of column 0 and row 0 [m]
  double spacing = 1;         // between columns, and rows [m]
  std::string title;          // one line
  std::string unit;           // of the values
};

// The drawing as an SVG file: x to the right, y upwards. Each value is a square of one spacing. The scale
// begins at 0 and ends at the largest value. Equal maps give equal bytes. REQUIRES: the grid has a value that
// is not nan.
std::string ValueMapSvg(const ValueMap& map);

}  // namespace penumbra
