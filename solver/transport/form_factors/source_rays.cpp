#include "solver/transport/form_factors/source_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/transport/links/cubature.h"

namespace penumbra {
namespace {

constexpr std::size_t kManyRays = 1000;  // so many allow for more points

// The mean with the standard error of the rays alone.
FormFactorEstimate MeanOverPoints(const SightedPair& pair, const std::vector<CubaturePoint>& points,
                                  RayFormula formula, Random* random) {
  const std::size_t rays = std::max<std::size_t>(1, pair.rays / points.size());
  FormFactorEstimate sum;
  double squares = 0;
  for (const CubaturePoint& point : points) {
    const FormFactorEstimate at = PointFactorByRays(pair, point.position, rays, formula, random);
    sum.factor += point.weight * at.factor;
    squares += point.weight * point.weight * at.error * at.error;
    sum.points += at.points;
  }
  sum.error = std::sqrt(squares);
  return sum;
}

}  // namespace

FormFactorEstimate PointFactorByRays(const SightedPair& pair, const Vec3& at, std::size_t rays,
                                     RayFormula formula, Random* random) {
  const double area = VectorArea(pair.target).norm(), disk = area / static_cast<double>(rays);
  SampleMean mean;
  for (std::size_t i = 0; i < rays; ++i) {
    const double s = random->Uniform(), t = random->Uniform();
    const Vec3 to = UniformPoint(pair.target, s, t);
    double value = area * PointKernel(pair, at, to);
    if (formula == RayFormula::kDisks) {
      const double sphere = std::numbers::pi * (to - at).squaredNorm();
      value *= sphere / (sphere + disk);
    }
    mean.Add(value > 0 && InSight(pair, at, to) ? value : 0, value);
  }
  return mean.Estimate();
}

FormFactorEstimate FactorBySourceRays(const SightedPair& pair, RayFormula formula) {
  Random random = pair.of_pair;
  const bool many = pair.rays > kManyRays;
  FormFactorEstimate mean = MeanOverPoints(pair, Cubature(pair.sender, many ? 1 : 0), formula, &random);
  const std::vector<CubaturePoint> centre = {{Centroid(pair.sender), 1}};
  const FormFactorEstimate coarse =
      MeanOverPoints(pair, many ? Cubature(pair.sender, 0) : centre, formula, &random);
  mean.error += std::abs(mean.factor - coarse.factor);
  return mean;
}

}  // namespace penumbra
