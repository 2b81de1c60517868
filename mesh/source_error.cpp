#include "mesh/source_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/mesh_locator.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/ray_caster.h"

namespace penumbra {
namespace {

constexpr std::size_t kPointGrain = 8;
constexpr double kFloor = 0.01;  // of the channel's mean irradiance

// The mean of what the interpolants' radiosity exceeds the leaves' by, where cosine-distributed rays hit
// fronts.
class RayComparison {
 public:
  RayComparison(const RadiositySolution& solution, const IrradianceMesh& mesh)
      : solution_(solution),
        scene_(solution.forest.scene()),
        mesh_(mesh),
        locator_(scene_, mesh),
        caster_(scene_) {}

  Rgb At(const SurfacePoint& point, Random random) const {
    const Frame frame = MakeFrame(point.position, scene_.patches[point.patch].normal);
    const double first = random.Uniform(), second = random.Uniform();
    Rgb sum = Rgb::Zero();
    for (std::size_t i = 0; i < kRaysOfSourceError; ++i) {
      const double s = AdditiveRecurrence(i, kR2Alpha[0], first),
                   t = AdditiveRecurrence(i, kR2Alpha[1], second);
      const double radius = std::sqrt(s), angle = 2 * std::numbers::pi * t;
      const Vec3 direction = radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v +
                             std::sqrt(1 - s) * frame.n;
      const RayCaster::Hit hit = caster_.Cast(point.position, direction, point.patch);
      if (hit.patch == kNoPatch || !hit.front) continue;
      sum += Excess(hit.patch, point.position + hit.distance * direction);
    }
    return sum / static_cast<double>(kRaysOfSourceError);
  }

 private:
  Rgb Excess(PatchId patch, Vec3 at) const {
    const Patch& hit = scene_.patches[patch];
    at -= hit.normal.dot(at - hit.vertex[0]) * hit.normal;  // the ray was traced in float
    const auto place = locator_.Find(patch, at, kReach * std::sqrt(hit.area));
    if (!place) return Rgb::Zero();
    const Material& material = scene_.MaterialOf(patch);
    return material.emittance + material.reflectance * IrradianceAt(mesh_, *place) -
           solution_.RadiosityAt(patch, at);
  }

  static constexpr double kReach = 1e-4;  // of the patch's size: what float rays may land beside it

  const RadiositySolution& solution_;
  const Scene& scene_;
  const IrradianceMesh& mesh_;
  MeshLocator locator_;
  RayCaster caster_;
};

}  // namespace

double EstimateSourceError(const RadiositySolution& solution, const IrradianceMesh& mesh,
                           const IrradianceSampler& sampler, std::size_t points, std::uint64_t seed) {
  const Scene& scene = solution.forest.scene();
  if (scene.patches.empty() || points == 0) return 0;
  const std::vector<SurfacePoint> at = SpreadPoints(scene, points, seed);
  const RayComparison comparison(solution, mesh);
  std::vector<Rgb> irradiance(points), error(points);
  ParallelFor(points, kPointGrain, [&](std::size_t i) {
    ReceiverPoint receiver;
    receiver.position = at[i].position;
    receiver.normal = scene.patches[at[i].patch].normal;
    irradiance[i] = sampler(at[i].patch, receiver).irradiance;
    error[i] = comparison.At(at[i], Random(seed, i));
  });
  Rgb mean = Rgb::Zero();
  for (const Rgb& e : irradiance) mean += e / static_cast<double>(points);
  std::vector<double> relative;
  for (std::size_t i = 0; i < points; ++i)
    for (int c = 0; c < 3; ++c)
      if (mean[c] > 0)
        relative.push_back(std::abs(error[i][c]) / std::max(irradiance[i][c], kFloor * mean[c]));
  if (relative.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(relative.size()));
  std::nth_element(relative.begin(), relative.begin() + rank, relative.end());
  return relative[static_cast<std::size_t>(rank)];
}

}  // namespace penumbra
