// display/value_map.h
//
// A drawing of the values on a horizontal grid, with false colours, contour lines at round values, a colour
// scale, and axes in metres.

#pragma once

#include <string>

#include "display/contour_lines.h"
#include "solver/geometry/vec.h"

namespace penumbra {

struct ValueMap {
  ValueGrid grid;             // grid of values >= 0
  Vec2 first = Vec2::Zero();  // position (x, y) of the grid point in column 0 and row 0 [m]
  double spacing = 1;         // distance between columns, and between rows [m]
  std::string title;          // title of the drawing, one line
  std::string unit;           // unit of the values
};

// The drawing of the map as an SVG file, with x to the right and y upwards. Each value fills a square whose
// side is ValueMap::spacing. The colour scale begins at 0 and ends at the largest value of the map. Equal
// maps give SVG files with equal bytes. REQUIRES: the grid has a value that is not nan.
std::string ValueMapSvg(const ValueMap& map);

}  // namespace penumbra
