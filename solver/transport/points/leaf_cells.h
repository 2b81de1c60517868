// solver/transport/points/leaf_cells.h
//
// Cuts leaves into cells of nearly constant light. A link may treat the radiosity of a leaf as constant,
// because distance blurs it; a point close to the leaf may not. Near an edge where two walls meet, radiosity
// depends on the distance d from the edge as d^a with 0 < a < 1 (a = 0.763 for a right angle and reflectance
// 1/2). Cuts parallel to the edge halve the cell nearest to the edge again and again. If squares of the same
// accuracy number n, the number of cells is of the order of log n.

#pragma once

#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafCellOptions {
  // About the largest error of irradiance that the constant light of a cell may cause at other surfaces,
  // relative to the radiosity of the part around the cell.
  double error = 1e-3;
  // Radiosities below this count as this in the relative error [W/m^2].
  Rgb dark = Rgb::Zero();
  double min_area = 0;  // parts of at most this area are not halved [m^2]
};

// The light of a leaf. In each part irradiance is a linear function of position, fitted to samples; pieces of
// constant light replace the function.
struct LeafCells {
  std::vector<Polygon3> parts;
  std::vector<Fragment> pieces;  // convex, tile the leaf; with their light

  Rgb Mean() const;  // mean irradiance over the pieces [W/m^2]
};

// The mean radiosity that the fronts of the scene reflect [W/m^2].
Rgb MeanReflected(const RadiositySolution& solution);

// The light of a leaf from the sources of `exact`. A part is halved by a line parallel to one of its edges
// until, by the samples (Cubature), a few pieces in each direction meet options.error. The estimated error of
// a piece in a direction is proportional to (change of radiosity over the piece) * (width of the piece) /
// (distance to the nearest patch that sees the piece). `start` holds the initial parts: the parts of an
// earlier call, or the pieces between the leaf's contacts.
LeafCells CutLeaf(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
                  std::vector<Polygon3> start, const LeafCellOptions& options);

}  // namespace penumbra
