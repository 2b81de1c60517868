// experiments/studies/lagrange_interpolant.h
//
// Interpolants of degrees 0 to 3 over a triangle, for comparison with the thesis's quadratic interpolant
// (3.3): the constant basis, Gouraud's linear interpolant, and the cubic. Vertex 0 is at (s, t) = (0, 0),
// vertex 1 at (1, 0), vertex 2 at (0, 1).

#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

inline constexpr int kMaxInterpolantDegree = 3;

// The nodes (s, t) of an interpolant of this degree: 1, 3, 6 or 10 points, in rows of ascending t; the
// centroid for a constant. REQUIRES: 0 <= degree <= kMaxInterpolantDegree.
std::vector<std::array<double, 2>> InterpolationNodes(int degree);

// The value at (s, t) of the polynomial of this degree through `samples` at InterpolationNodes(degree).
// REQUIRES: there are as many samples as nodes.
Rgb InterpolateLagrange(int degree, std::span<const Rgb> samples, double s, double t);

}  // namespace penumbra
