// solver/visibility/point/arc_tangent.h
//
// A branch-free arc tangent, for loops that the compiler vectorises. The arc tangents are the same for every
// vector width.

#pragma once

#include <array>
#include <cstddef>
#include <numbers>

namespace penumbra::internal {

// Coefficients that approximate atan(x) on [0, tan(pi/8)] by x times a polynomial in x^2. The polynomial
// interpolates atan(x)/x at twelve Chebyshev nodes; its error on [0, tan(pi/8)] is 4e-18.
inline constexpr std::array<double, 12> kArcTangent = {1.0,
                                                       -0.3333333333333312,
                                                       0.19999999999940893,
                                                       -0.14285714279250245,
                                                       0.11111110744919658,
                                                       -0.09090896809064027,
                                                       0.07692045330902225,
                                                       -0.06662951813629191,
                                                       0.05846878297330872,
                                                       -0.05035102456601552,
                                                       0.03796525745386593,
                                                       -0.017805397205419446};
inline constexpr double kTanEighthPi = 0.41421356237309503;

// Computes atan2(y, x) for y >= 0, without branches.
[[gnu::always_inline]] inline double AngleOf(double y, double x) {
  const double ax = x < 0 ? -x : x;
  const double low = y < ax ? y : ax, high = y < ax ? ax : y;
  const bool big = low > kTanEighthPi * high;
  // For angles a > pi/8, the identity tan(a - pi/4) = (tan a - 1) / (tan a + 1) reduces the argument.
  const double numerator = big ? low - high : low, denominator = big ? low + high : high;
  const double t = numerator / (denominator > 0 ? denominator : 1.0);
  const double z = t * t;
  double p = kArcTangent[11];
#pragma GCC unroll 11
  for (int k = 10; k >= 0; --k) p = p * z + kArcTangent[static_cast<std::size_t>(k)];
  const double first = (big ? std::numbers::pi / 4 : 0.0) + t * p;
  const double octant = y < ax ? first : std::numbers::pi / 2 - first;
  return x < 0 ? std::numbers::pi - octant : octant;
}

}  // namespace penumbra::internal
