// experiments/studies/lagrange_interpolant.h
//
// Interpolants of degree 0 to 3 over a triangle, to compare the quadratic with that the thesis settled on
// (3.3): the constant basis, Gouraud's linear one, and the cubic. Vertex 0 is at (s, t) = (0, 0), vertex 1 at
// (1, 0), vertex 2 at (0, 1).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

inline constexpr int kMaxInterpolantDegree = 3;

// Where a degree is sampled: 1, 3, 6 or 10 places, rows of ascending t; a constant at the centroid.
// REQUIRES: 0 <= degree <= kMaxInterpolantDegree.
std::vector<std::array<double, 2>> InterpolationNodes(int degree);

// The value at (s, t) of the polynomial of the degree through the samples at those places.
// REQUIRES: as many samples as nodes.
Rgb InterpolateLagrange(int degree, std::span<const Rgb> samples, double s, double t);

}  // namespace penumbra
