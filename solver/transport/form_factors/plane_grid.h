// solver/transport/form_factors/plane_grid.h
//
// A plane before a point, divided into square cells. The form factor of the point to a polygon is the sum of
// the form factors of those cells through which the point sees the polygon (Cohen and Greenberg 1985).

#pragma once

#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

// How the form factor of a cell is found.
enum class CellRule {
  kExact,   // the form factor of the cell's square: all cells of a hemicube add up to 1
  kCentre,  // (kernel at the cell's centre) * (area), as printed by Ashdown (1994, eq. 5.15, 5.18 and 5.25)
};

// A plane at distance 1 from the point, seen along `ahead`. The axes are orthonormal, in the point's frame,
// whose z axis is the normal there.
struct PlaneGrid {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitY(), ahead = Vec3::UnitZ();
  Vec2 low = Vec2::Zero();  // coordinates of the corner of cell (0, 0), along `right` and `up`
  double cell = 1;          // side of a cell
  int columns = 0, rows = 0;
  // True for the faces of a cubic tetrahedron. The horizon then halves cell (columns - 1 - row, row) of each
  // row; the upper right half lies above. Cells to the left of it lie below the horizon.
  bool halved = false;
  std::vector<double> delta;  // the form factor of each cell, row by row

  // The first column of a row that lies above the horizon as a whole.
  int FirstWhole(int row) const { return halved ? columns - row : 0; }
};

// Sets the form factors of all cells.
void FindDeltas(PlaneGrid* grid, CellRule rule = CellRule::kExact);

// The sum of all form factors: the fraction of the diffuse flux that leaves the point through the plane.
double SumOfDeltas(const PlaneGrid& grid);

}  // namespace penumbra
