// solver/transport/form_factors/plane_grid.h
//
// A plane in front of a point, divided into square cells. The form factor of the point to a polygon is the
// sum of the form factors of those cells through which the point sees the polygon (Cohen and Greenberg 1985).

#pragma once

#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// How the form factor of a cell of the plane is computed.
enum class CellRule {
  kExact,  // the exact form factor of the cell's square: all cells of a hemicube add up to 1
  // (integrand of the form factor at the cell's centre) * (area of the cell), as printed by Ashdown (1994,
  // eq. 5.15, 5.18 and 5.25)
  kCentre,
};

// A plane at distance 1 from the point in the direction `ahead`. The axes `right`, `up` and `ahead` are
// orthonormal, in the frame of the point, whose z axis is the surface normal.
struct PlaneGrid {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), ahead = Vec3::UnitZ();
  Vec2 low = Vec2::Zero();  // coordinates of the corner of cell (0, 0), along `right` and `up`
  double cell = 1;          // side length of a cell, relative to the distance between the plane and the point
  int columns = 0, rows = 0;
  // True if the plane is a face of a cubic tetrahedron. In each row of a cubic tetrahedron's face, the
  // horizon cuts cell (columns - 1 - row, row) into halves, and the upper right half lies above the horizon.
  // In a cubic tetrahedron's face, cells to the left of the halved cell lie below the horizon.
  bool halved = false;
  std::vector<double> delta;  // the form factor of the point to each cell, row by row

  // The column of the first cell that lies completely above the horizon, in the given row.
  int FirstWhole(int row) const { return halved ? columns - row : 0; }
};

// Computes PlaneGrid::delta, the form factors of all cells.
void FindDeltas(PlaneGrid* grid, CellRule rule = CellRule::kExact);

// The sum of the form factors of all cells: the fraction of the point's diffuse flux that passes through the
// plane.
double SumOfDeltas(const PlaneGrid& grid);

}  // namespace penumbra
