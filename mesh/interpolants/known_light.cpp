#include "mesh/interpolants/known_light.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/transport/sources/error_floors.h"
#include "solver/visibility/point/enclosure.h"

namespace penumbra {

IrradianceSampler Remembering(IrradianceSampler sampler, std::vector<KnownLight>& known) {
  return IrradianceSampler::OfMany(
      [sampler = std::move(sampler), &known](std::span<const PatchPoint> points,
                                             std::span<PointIrradianceResult> results) {
        sampler.SampleAll(points, results);
        for (std::size_t i = 0; i < points.size(); ++i)
          known.push_back({points[i].patch, points[i].at.position, results[i].irradiance});
      });
}

void RaiseErrors(const Scene& scene, const IrradianceMesh& mesh, std::span<const KnownLight> known,
                 const TriangleSampling& sampling, std::span<TriangleError> errors) {
  PENUMBRA_CHECK(errors.size() == mesh.triangles.size());
  if (known.empty()) return;
  const MeshLocator locator(scene, mesh);
  std::vector<std::optional<MeshLocator::Location>> places(known.size());
  constexpr std::size_t kPointsATask = 64;
  ParallelFor(known.size(), kPointsATask,
              [&](std::size_t i) { places[i] = locator.Find(known[i].patch, known[i].position); });
  const Rgb floor = kErrorFloor * sampling.mean, no_light = NoLight(scene);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!places[i]) continue;
    const Vec3& normal = scene.patches[static_cast<std::size_t>(known[i].patch)].normal;
    if (sampling.enclosure && (known[i].irradiance <= no_light).all() &&
        sampling.enclosure->Surrounds(known[i].position, normal))
      continue;
    const Rgb shown = IrradianceAt(mesh, *places[i]).max(0.0);
    const Rgb difference = (shown - known[i].irradiance).abs();
    double& largest = errors[places[i]->triangle].max;
    for (int c = 0; c < 3; ++c)
      if (difference[c] > 0)
        largest = std::max(largest, difference[c] / std::max(known[i].irradiance[c], floor[c]));
  }
}

}  // namespace penumbra
