// experiments/studies/lagrange_interpolant.h
//
// Polynomial interpolants of degrees 0 to 3 over a triangle, for comparison with the thesis's quadratic
// interpolant (thesis 3.3). Degree 0 is the constant basis, degree 1 Gouraud interpolation, and degree 3 the
// cubic. In barycentric coordinates (s, t), vertex 0 of the triangle is at (0, 0), vertex 1 at (1, 0), vertex
// 2 at (0, 1).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

inline constexpr int kMaxInterpolantDegree = 3;

// Returns the nodes (s, t) of the polynomial interpolant of this degree: 1, 3, 6 or 10 points, in rows of
// ascending t. The only node of the constant interpolant is the centroid. REQUIRES: 0 <= degree <=
// kMaxInterpolantDegree.
std::vector<std::array<double, 2>> InterpolationNodes(int degree);

// Returns the value at (s, t) of the polynomial of degree `degree` through `samples` at the points
// InterpolationNodes(degree). REQUIRES: the number of samples equals the number of nodes.
Rgb InterpolateLagrange(int degree, std::span<const Rgb> samples, double s, double t);

}  // namespace penumbra
