// solver/transport/points/leaf_cells.h
//
// Cuts leaves (undivided quadtree elements) into cells of nearly constant radiosity. For distant receivers,
// the radiosity of a leaf may be treated as constant; for points close to the leaf, the variation of the
// radiosity matters. Near an edge where two walls meet, radiosity depends on the distance d from the edge as
// d^a with 0 < a < 1 (a = 0.763 for a right angle and reflectance 1/2). Cuts parallel to the edge where walls
// meet repeatedly halve the cell that is nearest to the edge. The number of cells from cuts parallel to the
// edge where walls meet is O(log n), where n is the number of square cells that would give the same accuracy.

#pragma once

#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafCellOptions {
  // The approximate limit of e / B, where e is the error of the irradiance at other surfaces if the radiosity
  // of a cell is treated as constant, and B is the radiosity around the cell.
  double error = 1e-3;
  // The lower bound of the denominator of relative errors: the denominator is max(radiosity, dark) [W/m^2].
  Rgb dark = Rgb::Zero();
  double min_area = 0;  // parts of leaves with at most this area are not halved [m^2]
};

// The light of a leaf, cut into convex parts. In each part of the leaf, a linear function of position is
// fitted to samples of the irradiance. Within each part of the leaf, pieces of constant irradiance
// approximate the linear function.
struct LeafCells {
  std::vector<Polygon3> parts;
  std::vector<Fragment> pieces;  // convex pieces that tile the leaf, with their irradiance and radiosity

  Rgb Mean() const;  // mean irradiance over the pieces [W/m^2]
};

// The mean reflected radiosity over the fronts of all patches of the scene [W/m^2].
Rgb MeanReflected(const RadiositySolution& solution);

// Computes the light that a leaf receives from the sources of the PointIrradiance `exact`. Parts of the leaf
// are halved by lines parallel to one of their edges, until each part needs only a few pieces of constant
// irradiance in each direction to meet options.error. The error of a piece of constant radiosity is estimated
// by a multiple of (change of radiosity over the piece) * (width of the piece) / (distance to the nearest
// patch that sees the piece). `start` holds the initial parts of the leaf: the parts from an earlier call, or
// the pieces into which contacts with other surfaces divide the leaf.
LeafCells CutLeaf(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
                  std::vector<Polygon3> start, const LeafCellOptions& options);

}  // namespace penumbra
