#include "experiments/studies/lagrange_interpolant.h"

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The product over m = 0 ... k - 1 of (degree x - m) / (m + 1): 1 at x = k / degree, 0 at the nodes before.
double Rising(int degree, int k, double x) {
  double product = 1;
  for (int m = 0; m < k; ++m) product *= (degree * x - m) / (m + 1);
  return product;
}

}  // namespace

std::vector<std::array<double, 2>> InterpolationNodes(int degree) {
  PENUMBRA_CHECK(degree >= 0 && degree <= kMaxInterpolantDegree);
  if (degree == 0) return {{1.0 / 3, 1.0 / 3}};
  std::vector<std::array<double, 2>> nodes;
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i + j <= degree; ++i)
      nodes.push_back({static_cast<double>(i) / degree, static_cast<double>(j) / degree});
  return nodes;
}

Rgb InterpolateLagrange(int degree, std::span<const Rgb> samples, double s, double t) {
  PENUMBRA_CHECK(degree >= 0 && degree <= kMaxInterpolantDegree);
  PENUMBRA_CHECK(samples.size() == static_cast<std::size_t>((degree + 1) * (degree + 2) / 2));
  Rgb sum = Rgb::Zero();
  std::size_t node = 0;
  for (int j = 0; j <= degree; ++j)
    for (int i = 0; i + j <= degree; ++i)
      sum += Rising(degree, i, s) * Rising(degree, j, t) * Rising(degree, degree - i - j, 1 - s - t) *
             samples[node++];
  return sum;
}

}  // namespace penumbra
