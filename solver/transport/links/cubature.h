// solver/transport/links/cubature.h
//
// Sample points on a receiver for the mean of point form factors. Cubature() follows the thesis's third
// method for form factors (4.2), with the points of a cubature rule instead of random points.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct CubaturePoint {
  Vec3 position;      // position of the sample point [m]
  double weight = 0;  // weight of the sample point; the weights of all points of a rule add up to 1
};

// A cubature rule for the mean over a convex planar polygon. The cubature rule for a triangle has 3 points
// and is exact for polynomials of degree 2. The cubature rule for a quadrilateral has 2 x 2 Gauss-Legendre
// points and is exact for degree 3 in each parameter. Polygons of more than four vertices are cut into a fan
// of triangles. Before the cubature rule is applied, each polygon is split into four polygons, `refinement`
// times in succession.
std::vector<CubaturePoint> Cubature(std::span<const Vec3> polygon, int refinement = 0);

}  // namespace penumbra
