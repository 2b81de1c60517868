// mesh/interpolants/quadratic_interpolant.h
//
// The irradiance over one triangle as a quadratic in barycentric coordinates (thesis 3.3, eq. 3.1).
//
// Vertex 0 of the triangle is at (s, t) = (0, 0), vertex 1 at (1, 0), vertex 2 at (0, 1).

#pragma once

#include <array>

#include "solver/geometry/vec.h"

namespace penumbra {

// The barycentric coordinates (s, t) of a triangle's six samples in their order (thesis 3.3): vertex 0,
// midpoint of edge 01, vertex 1, midpoint of edge 12, vertex 2, midpoint of edge 20.
inline constexpr std::array<std::array<double, 2>, 6> kSampleAt = {
    {{0, 0}, {0.5, 0}, {1, 0}, {0.5, 0.5}, {0, 1}, {0, 0.5}}};

// The quadratic R(s, t) = a s^2 + b2 s t + c2 s + d t^2 + e2 t + f gives the irradiance in W/m^2 for each
// channel. As in the thesis, three coefficients of the quadratic are stored doubled: b2 = 2B, c2 = 2C and e2
// = 2E.
struct QuadraticInterpolant {
  Rgb a = Rgb::Zero(), b2 = Rgb::Zero(), c2 = Rgb::Zero(), d = Rgb::Zero(), e2 = Rgb::Zero(), f = Rgb::Zero();

  Rgb At(double s, double t) const { return (a * s + b2 * t + c2) * s + (d * t + e2) * t + f; }

  // The value at (s, t) of the quadratic through six samples is a weighted sum of the samples. WeightsAt()
  // returns the weights of a triangle's six samples in the order of kSampleAt.
  static std::array<double, 6> WeightsAt(double s, double t);
  // The quadratic through a triangle's six samples, which are in the order of kSampleAt. If the six samples
  // are values of a quadratic, the result is this quadratic, up to rounding.
  static QuadraticInterpolant Quadratic(const std::array<Rgb, 6>& r);
  // The linear interpolant through samples at the three vertices of a triangle.
  static QuadraticInterpolant Linear(const std::array<Rgb, 3>& r);
  static QuadraticInterpolant Constant(const Rgb& r);
};

}  // namespace penumbra
