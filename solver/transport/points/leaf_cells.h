// solver/transport/points/leaf_cells.h
//
// Cuts leaves into cells whose light is even enough for who sees it. Links may treat a leaf's radiosity as
// constant, since distance blurs; a point beside the leaf cannot. Towards edges where walls meet radiosity
// goes as a power of the distance between 0 and 1 (0.763 at a right angle and reflectance 1/2): cells are cut
// by lines along the edge, at halves of the distance again and again, which costs a number of cells that
// grows as the logarithm of what squares would cost.

#pragma once

#include <vector>

#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

struct LeafCellOptions {
  // About the largest error, relative to the radiosity around, that a cell's constant light may cause where
  // it arrives.
  double error = 1e-3;
  // Radiosity below this counts as this much [W/m^2].
  Rgb dark = Rgb::Zero();
  double min_area = 0;  // of parts that are halved [m^2]
};

// A leaf's light in parts. On each the samples give a linear function of the place, which even pieces of the
// part stand for.
struct LeafCells {
  std::vector<Polygon3> parts;
  std::vector<Fragment> pieces;  // convex, with their light; together they tile the leaf

  Rgb Mean() const;  // irradiance [W/m^2]
};

// The mean of what the fronts reflect [W/m^2].
Rgb MeanReflected(const RadiositySolution& solution);

// The leaf's light by the sources that `exact` knows. Parts are halved, by a line along one of their edges,
// until the samples (Cubature) say that a few pieces each way err by no more than is asked for. The error of
// a piece is how much radiosity changes over it in a direction, times its width in that direction over its
// distance from the nearest patch that sees it. `start` is what the leaf is first cut into: the parts of a
// former call, or what its contacts make of it.
LeafCells CutLeaf(const RadiositySolution& solution, const PointIrradiance& exact, ElementId leaf,
                  std::vector<Polygon3> start, const LeafCellOptions& options);

}  // namespace penumbra
