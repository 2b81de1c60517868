// The orders with which interpolants of degree 0 to 3 converge.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <vector>

#include "experiments/studies/lagrange_interpolant.h"
#include "mesh/interpolants/quadratic_interpolant.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

using LightField = std::function<double(double x, double y)>;

// The largest error over a grid of n x n squares of the unit square, each cut into two triangles, or, with
// `split`, along x = split instead where that runs through it.
double LargestError(const LightField& f, int degree, int n, double split = -1) {
  double worst = 0;
  const auto triangle = [&](const Vec2& a, const Vec2& b, const Vec2& c) {
    if (std::abs(Cross2(b - a, c - a)) < 1e-14) return;
    const auto at = [&](double s, double t) -> Vec2 { return a + s * (b - a) + t * (c - a); };
    // What lies on the edge belongs to the side of the triangle.
    const Vec2 centre = (a + b + c) / 3;
    const auto value = [&](const Vec2& p) { return f(p.x() + 1e-13 * (centre.x() - p.x()), p.y()); };
    std::vector<Rgb> samples;
    for (const auto& [s, t] : InterpolationNodes(degree)) samples.push_back(Rgb::Constant(value(at(s, t))));
    constexpr int kTries = 12;
    for (int j = 0; j <= kTries; ++j)
      for (int i = 0; i + j <= kTries; ++i) {
        const double s = static_cast<double>(i) / kTries, t = static_cast<double>(j) / kTries;
        worst = std::max(worst, std::abs(InterpolateLagrange(degree, samples, s, t)[0] - value(at(s, t))));
      }
  };
  const auto box = [&](double x0, double x1, double y0, double y1) {
    triangle({x0, y0}, {x1, y0}, {x1, y1});
    triangle({x0, y0}, {x1, y1}, {x0, y1});
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double h = 1.0 / n, x0 = i * h, x1 = x0 + h, y0 = j * h;
      if (x0 < split && split < x1) {
        box(x0, split, y0, y0 + h);
        box(split, x1, y0, y0 + h);
      } else {
        box(x0, x1, y0, y0 + h);
      }
    }
  return worst;
}

double Order(const LightField& f, int degree, double split = -1) {
  // Coarse against fine, by a factor that keeps the edge at the same place in its square: 1/3 of it.
  constexpr int kCoarse = 16, kFine = 64;
  return std::log2(LargestError(f, degree, kCoarse, split) / LargestError(f, degree, kFine, split)) /
         std::log2(static_cast<double>(kFine) / kCoarse);
}

// Differential irradiance of a lamp at height 1 over (0.2, 0.4): smooth.
double Smooth(double x, double y) {
  const double d2 = 1 + (x - 0.2) * (x - 0.2) + (y - 0.4) * (y - 0.4);
  return 1 / (d2 * d2);
}

constexpr double kEdge = 0.3333333333333333;

// An edge across which the irradiance, its gradient or its second derivative jumps (D0, D1, D2).
LightField WithJump(int derivative) {
  return [derivative](double x, double y) {
    const double beyond = x - kEdge;
    constexpr double kStrong = 30;  // so that what the smooth part adds to the error does not show
    const double jump = beyond <= 0 ? 0 : kStrong * std::pow(beyond, derivative);
    return Smooth(x, y) + jump * (1 + y);
  };
}

// Where irradiance is smooth an interpolant of degree n converges with the power n + 1 of the size; across an
// edge that is not meshed with the power of the derivative that jumps there, if that is smaller; and once the
// edge is meshed with its own power again.
TEST(InterpolantOrder, FollowsDegreeAndEdge) {
  std::printf("degree  smooth      D0  meshed      D1  meshed      D2  meshed\n");
  for (int degree = 0; degree <= kMaxInterpolantDegree; ++degree) {
    std::printf("%6d  %6.2f", degree, Order(Smooth, degree));
    constexpr double kNear = 0.15;  // of an order: the next term at these sizes
    EXPECT_NEAR(Order(Smooth, degree), degree + 1, kNear);
    for (int derivative = 0; derivative <= 2; ++derivative) {
      const double unmeshed = Order(WithJump(derivative), degree),
                   meshed = Order(WithJump(derivative), degree, kEdge);
      std::printf("  %6.2f  %6.2f", unmeshed, meshed);
      EXPECT_NEAR(unmeshed, std::min(derivative, degree + 1), kNear);
      EXPECT_NEAR(meshed, degree + 1, kNear);
    }
    std::printf("\n");
  }
}

// Polynomials of its degree are reproduced by each, to rounding, and the quadratic is the one that the mesh
// stores.
TEST(InterpolantOrder, PolynomialsAreReproduced) {
  Random random(5);
  double worst = 0;
  for (int round = 0; round < 200; ++round)
    for (int degree = 0; degree <= kMaxInterpolantDegree; ++degree) {
      double c[4][4];
      for (auto& row : c)
        for (double& x : row) x = random.Uniform(-1, 1);
      const auto f = [&](double s, double t) {
        double sum = 0;
        for (int i = 0; i <= degree; ++i)
          for (int j = 0; i + j <= degree; ++j) sum += c[i][j] * std::pow(s, i) * std::pow(t, j);
        return Rgb::Constant(sum);
      };
      std::vector<Rgb> samples;
      for (const auto& [s, t] : InterpolationNodes(degree)) samples.push_back(f(s, t));
      const double s = random.Uniform(), t = random.Uniform(0, 1 - s);
      worst = std::max(worst, std::abs(InterpolateLagrange(degree, samples, s, t)[0] - f(s, t)[0]));
      if (degree != 2) continue;
      std::array<Rgb, 6> stored;
      for (std::size_t i = 0; i < 6; ++i) stored[i] = f(kSampleAt[i][0], kSampleAt[i][1]);
      worst = std::max(worst, std::abs(QuadraticInterpolant::Quadratic(stored).At(s, t)[0] - f(s, t)[0]));
    }
  constexpr double kRounding = 1e-13;
  std::printf("largest error %.2g, bound %.2g\n", worst, kRounding);
  EXPECT_LE(worst, kRounding);
}

}  // namespace
}  // namespace penumbra
