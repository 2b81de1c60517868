#include "mesh/representation_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

// The value that the fraction q of the ascending list does not pass.
double Quantile(const std::vector<double>& ascending, double q) {
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(ascending.size())));
  return ascending[std::clamp<std::size_t>(rank, 1, ascending.size()) - 1];
}

}  // namespace

RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed) {
  RepresentationError error;
  if (scene.patches.empty() || points == 0) return error;
  const std::vector<SurfacePoint> at = SpreadPoints(scene, points, seed);
  const MeshLocator locator(scene, mesh);
  std::vector<Rgb> shown(points), truth(points);
  constexpr std::size_t kPointsATask = 32;
  ParallelFor(points, kPointsATask, [&](std::size_t i) {
    const auto place = locator.Find(at[i].patch, at[i].position);
    PENUMBRA_CHECK(place.has_value());
    shown[i] = IrradianceAt(mesh, *place).max(0.0);
    ReceiverPoint receiver;
    receiver.position = at[i].position;
    receiver.normal = scene.patches[at[i].patch].normal;
    truth[i] = sampler(at[i].patch, receiver).irradiance;
  });

  Rgb mean = Rgb::Zero();
  for (const Rgb& e : truth) mean += e / static_cast<double>(points);
  constexpr double kFloor = 0.01;  // of the mean
  std::vector<double> errors;
  double squares = 0;
  for (std::size_t i = 0; i < points; ++i)
    for (int c = 0; c < 3; ++c) {
      const double difference = std::abs(shown[i][c] - truth[i][c]);
      const double relative = difference == 0 ? 0 : difference / std::max(truth[i][c], kFloor * mean[c]);
      errors.push_back(relative);
      squares += relative * relative;
      if (relative > error.max) {
        error.max = relative;
        error.worst_patch = at[i].patch;
        error.worst_point = at[i].position;
      }
    }
  std::sort(errors.begin(), errors.end());
  error.points = points;
  error.p99 = Quantile(errors, 0.99);
  error.p95 = Quantile(errors, 0.95);
  error.rms = std::sqrt(squares / static_cast<double>(errors.size()));
  return error;
}

}  // namespace penumbra
