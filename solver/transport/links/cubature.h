// solver/transport/links/cubature.h
//
// Where a receiver is sampled to average point form factors over it (the thesis's third method, 4.2, with
// points that are chosen well instead of at random).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct CubaturePoint {
  Vec3 position;      // [m]
  double weight = 0;  // the weights of a rule add up to 1
};

// A rule for the mean over a convex planar polygon: over a triangle exact for polynomials of degree 2 (3
// points), over a quadrilateral of degree 3 in each of its parameters (2 x 2 Gauss-Legendre points), over
// others a fan of triangles. Each level of `refinement` splits the polygon into four first.
std::vector<CubaturePoint> Cubature(std::span<const Vec3> polygon, int refinement = 0);

}  // namespace penumbra
