#include "mesh/interpolants/quadratic_interpolant.h"

namespace penumbra {

std::array<double, 6> QuadraticInterpolant::WeightsAt(double s, double t) {
  const double r = 1 - s - t;
  return {r * (2 * r - 1), 4 * r * s, s * (2 * s - 1), 4 * s * t, t * (2 * t - 1), 4 * r * t};
}

QuadraticInterpolant QuadraticInterpolant::Quadratic(const std::array<Rgb, 6>& r) {
  QuadraticInterpolant q;
  q.a = 2 * r[0] - 4 * r[1] + 2 * r[2];
  q.b2 = 4 * (r[0] - r[1] + r[3] - r[5]);
  q.c2 = -3 * r[0] + 4 * r[1] - r[2];
  q.d = 2 * r[0] + 2 * r[4] - 4 * r[5];
  q.e2 = -3 * r[0] - r[4] + 4 * r[5];
  q.f = r[0];
  return q;
}

QuadraticInterpolant QuadraticInterpolant::Linear(const std::array<Rgb, 3>& r) {
  QuadraticInterpolant q;
  q.c2 = r[1] - r[0];
  q.e2 = r[2] - r[0];
  q.f = r[0];
  return q;
}

QuadraticInterpolant QuadraticInterpolant::Constant(const Rgb& r) {
  QuadraticInterpolant q;
  q.f = r;
  return q;
}

}  // namespace penumbra
