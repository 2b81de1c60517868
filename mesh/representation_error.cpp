#include "mesh/representation_error.h"

#include <algorithm>
#include <cmath>

#include "mesh/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

// Of the errors at these points, three each.
RepresentationError Summarise(std::span<const SurfacePoint> at, const std::vector<double>& errors) {
  RepresentationError error;
  double squares = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += errors[i] * errors[i];
    if (errors[i] <= error.max) continue;
    error.max = errors[i];
    error.worst_patch = at[i / 3].patch;
    error.worst_point = at[i / 3].position;
  }
  error.points = at.size();
  error.p99 = Quantile(errors, 0.99);
  const double deviation = std::sqrt(0.99 * 0.01 / static_cast<double>(at.size()));
  error.p99_at_most = Quantile(errors, std::min(0.99 + deviation, 1.0));
  error.p95 = Quantile(errors, 0.95);
  error.rms = std::sqrt(squares / static_cast<double>(errors.size()));
  return error;
}

}  // namespace

std::vector<double> RelativeErrors(std::span<const Rgb> shown, std::span<const Rgb> truth) {
  Rgb mean = Rgb::Zero();
  for (const Rgb& e : truth) mean += e / static_cast<double>(truth.size());
  std::vector<double> errors;
  errors.reserve(3 * truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(shown[i][c] - truth[i][c]);
      errors.push_back(difference == 0 ? 0 : difference / std::max(truth[i][c], kErrorFloor * mean[c]));
    }
  return errors;
}

double Quantile(std::vector<double> values, double q) {
  PENUMBRA_CHECK(!values.empty());
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

MeasuredError MeasureError(const Scene& scene, const IrradianceMesh& mesh, const IrradianceSampler& sampler,
                           const IrradianceSampler& better, std::size_t points, std::uint64_t seed,
                           double bound) {
  MeasuredError error;
  if (scene.patches.empty() || points == 0) return error;
  const std::vector<SurfacePoint> at = SpreadPoints(scene, points, seed);
  const MeshLocator locator(scene, mesh);
  std::vector<Rgb> shown(points), exact(points), truth(points);
  constexpr std::size_t kPointsATask = 16;
  ParallelFor(points, kPointsATask, [&](std::size_t i) {
    const auto place = locator.Find(at[i].patch, at[i].position);
    PENUMBRA_CHECK(place.has_value());
    shown[i] = IrradianceAt(mesh, *place).max(0.0);
    ReceiverPoint receiver;
    receiver.position = at[i].position;
    receiver.normal = scene.patches[static_cast<std::size_t>(at[i].patch)].normal;
    exact[i] = sampler(at[i].patch, receiver).irradiance;
    if (better) truth[i] = better(at[i].patch, receiver).irradiance;
  });
  error.interpolant = Summarise(at, RelativeErrors(shown, exact));
  if (!better) return error;
  error.sources = Summarise(at, RelativeErrors(exact, truth));
  const std::vector<double> errors = RelativeErrors(shown, truth);
  error.whole = Summarise(at, errors);
  error.above =
      static_cast<double>(std::count_if(errors.begin(), errors.end(), [&](double e) { return e > bound; })) /
      static_cast<double>(errors.size());
  return error;
}

RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed) {
  return MeasureError(scene, mesh, sampler, {}, points, seed, 0).interpolant;
}

}  // namespace penumbra
