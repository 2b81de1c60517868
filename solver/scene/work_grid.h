// solver/scene/work_grid.h
//
// Regular grids of points at which the light on a horizontal plane is measured, such as the working plane of
// a room. The z axis points up.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// A point of a grid, with its column and its row; column 0 has the smallest x, row 0 the smallest y.
struct GridPoint {
  int column = 0, row = 0;
  Vec3 position = Vec3::Zero();  // the position of the grid point [m]
};

struct WorkGrid {
  int columns = 0, rows = 0;
  // The distance between neighbouring columns of the grid, and between neighbouring rows [m].
  double spacing = 0;
  Vec2 first = Vec2::Zero();  // the coordinates x and y of the grid point in column 0 and row 0 [m]
  // Points of the grid, by row, then by column; some rows and columns may lack points.
  std::vector<GridPoint> points;
};

// The largest permitted number of points of a grid.
inline constexpr double kMostGridPoints = 1e7;

// Makes a grid over the horizontal extent of the given faces. The grid is centred, and has as many points as
// fit along x and y at the distance `spacing` [m]. Each point lies at the height `height` [m] above the
// highest of the given faces that look upwards at its x and y. Positions where no given face looks upwards
// have no point. Throws InputError, without a file name, if no face looks upwards or if the grid would have
// too many points.
WorkGrid GridOverFaces(const Scene& scene, std::span<const std::int32_t> faces, double height,
                       double spacing);

// Makes a grid over the horizontal extent of the scene, with all points at the height z [m]. Throws
// InputError, without a file name, if the scene is empty or if the grid would have too many points.
WorkGrid GridAtHeight(const Scene& scene, double z, double spacing);

}  // namespace penumbra
