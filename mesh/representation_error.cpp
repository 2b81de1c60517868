#include "mesh/representation_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

struct SamplePoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
};

// One point in each of `count` equal shares of the total area: the share's place along the list of patches is
// drawn within it, the place within the patch freely.
std::vector<SamplePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed) {
  std::vector<double> up_to;
  double total = 0;
  for (const Patch& patch : scene.patches) up_to.push_back(total += patch.area);
  Random random(seed);
  std::vector<SamplePoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = (static_cast<double>(i) + random.Uniform()) / static_cast<double>(count) * total;
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), at);
    const std::size_t p = std::min(static_cast<std::size_t>(found - up_to.begin()), up_to.size() - 1);
    const Patch& patch = scene.patches[p];
    // A quadrilateral is two triangles, chosen by area.
    std::array<Vec3, 3> corner = {patch.vertex[0], patch.vertex[1], patch.vertex[2]};
    const double first = VectorArea(corner).norm();
    if (patch.size == 4 && random.Uniform() * patch.area > first)
      corner = {patch.vertex[0], patch.vertex[2], patch.vertex[3]};
    double s = random.Uniform(), t = random.Uniform();
    if (s + t > 1) {
      s = 1 - s;
      t = 1 - t;
    }
    points.push_back(
        {static_cast<PatchId>(p), corner[0] + s * (corner[1] - corner[0]) + t * (corner[2] - corner[0])});
  }
  return points;
}

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
  const std::vector<SamplePoint> at = SpreadPoints(scene, points, seed);
  const MeshLocator locator(scene, mesh);
  std::vector<Rgb> shown(points), truth(points);
  constexpr std::size_t kPointsATask = 32;
  ParallelFor(points, kPointsATask, [&](std::size_t i) {
    const auto place = locator.Find(at[i].patch, at[i].position);
    PENUMBRA_CHECK(place.has_value());
    shown[i] = IrradianceAt(mesh, *place);
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
