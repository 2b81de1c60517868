// solver/transport/points/leaf_cells.h
//
// Cuts leaves into cells of nearly constant radiosity. For distant receivers, the radiosity of a leaf may be
// treated as constant; for a point close to the leaf, it may not. Near an edge where two walls meet,
// radiosity depends on the distance d from the edge as d^a with 0 < a < 1 (a = 0.763 for a right angle and
// reflectance 1/2). Cuts parallel to the edge repeatedly halve the cell that is nearest to the edge. The
// number of cells is O(log n), where n is the number of square cells that would give the same accuracy.

#pragma once

#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafCellOptions {
  // The approximate limit of (error of the irradiance at other surfaces if the radiosity of a cell is treated
  // as constant) / (radiosity of the part that contains the cell).
  double error = 1e-3;
  // The denominator of relative errors is max(radiosity, dark) [W/m^2].
  Rgb dark = Rgb::Zero();
  double min_area = 0;  // parts of at most this area are not halved [m^2]
};

// The light of a leaf. In each part, a linear function of position is fitted to samples of the irradiance;
// then pieces of constant irradiance approximate the linear function.
struct LeafCells {
  std::vector<Polygon3> parts;
  std::vector<Fragment> pieces;  // convex, tile the leaf; with their light

  Rgb Mean() const;  // mean irradiance over the pieces [W/m^2]
};

// The mean radiosity that the fronts of the scene reflect [W/m^2].
Rgb MeanReflected(const RadiositySolution& solution);

// Computes the light that a leaf receives from the sources of `exact`. Parts are halved by lines parallel to
// one of their edges, until a few pieces in each direction suffice to meet options.error according to the
// samples (Cubature). The error of a piece in a direction is estimated by a multiple of (change of radiosity
// over the piece) * (width of the piece) / (distance to the nearest patch that sees the piece). `start` holds
// the initial parts: the parts of an earlier call, or the pieces between the leaf's contacts.
LeafCells CutLeaf(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
                  std::vector<Polygon3> start, const LeafCellOptions& options);

}  // namespace penumbra
