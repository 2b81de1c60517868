// solver/scene/work_grid.h
//
// Regular grids of points at which the light on a horizontal plane is measured, such as the working plane of
// a room. z is up.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A point of a grid, in the column and the row of its position; row 0 has the smallest y.
struct GridPoint {
  int column = 0, row = 0;
  Vec3 position = Vec3::Zero();  // [m]
};

struct WorkGrid {
  int columns = 0, rows = 0;
  double spacing = 0;             // between neighbouring columns, and rows [m]
  Vec2 first = Vec2::Zero();      // x and y of column 0 and row 0 [m]
  std::vector<GridPoint> points;  // row by row; a column may lack points in some rows
};

// The most points of a grid.
inline constexpr double kMostGridPoints = 1e7;

// The grid over the horizontal extent of the faces: as many points as fit at this spacing along x and y, the
// whole centred, each `height` above the highest of the faces that look up there [m]. Where no face looks up,
// there is no point. Throws InputError, without a file name, if no face looks up or the points are too many.
WorkGrid GridOverFaces(const Scene& scene, std::span<const std::int32_t> faces, double height,
                       double spacing);

// The grid over the horizontal extent of the scene, all points at the height z [m]. Throws InputError,
// without a file name, if the scene is empty or the points are too many.
WorkGrid GridAtHeight(const Scene& scene, double z, double spacing);

}  // namespace penumbra
