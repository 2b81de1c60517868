// solver/transport/links/cubature.h
//
// Sample points on a receiver for the mean of point form factors (the thesis's third method, 4.2, with the
// points of a cubature rule instead of random points).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct CubaturePoint {
  Vec3 position;      // [m]
  double weight = 0;  // the weights of a rule add up to 1
};

// A rule for the mean over a convex planar polygon. On a triangle: 3 points, exact for polynomials of degree
// 2. On a quadrilateral: 2 x 2 Gauss-Legendre points, exact for degree 3 in each parameter. Other polygons
// are cut into a fan of triangles. Each level of `refinement` first splits the polygon into four.
std::vector<CubaturePoint> Cubature(std::span<const Vec3> polygon, int refinement = 0);

}  // namespace penumbra
