#include "solver/transport/energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/ray_caster.h"

namespace penumbra {
namespace {

constexpr std::size_t kRayGrain = 1024;

struct Ray {
  ElementId leaf;
  Vec3 origin, direction;
};

Vec3 CosineDirection(const Vec3& normal, double s, double t) {
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  const double radius = std::sqrt(s), angle = 2 * std::numbers::pi * t;
  return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v + std::sqrt(1 - s) * normal;
}

// The i-th ray of `count`, leaving the leaf whose share of the flux covers (i + 1/2) / count.
Ray MakeRay(const RadiositySolution& solution, const std::vector<ElementId>& leaves,
            const std::vector<double>& cumulative, std::size_t i, std::size_t count, std::uint64_t seed) {
  const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * cumulative.back();
  const auto leaf = static_cast<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), at) -
                                             cumulative.begin());
  const Element& element = solution.forest[leaves[std::min(leaf, leaves.size() - 1)]];
  std::array<double, 4> x;
  for (std::size_t d = 0; d < 4; ++d) x[d] = AdditiveRecurrence(i + 7919 * seed, kR4Alpha[d]);
  const Vec3& normal = solution.forest.scene().patches[element.patch].normal;
  return {leaves[std::min(leaf, leaves.size() - 1)], PointOn(element.Vertices(), x[0], x[1]),
          CosineDirection(normal, x[2], x[3])};
}

}  // namespace

EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays, std::uint64_t seed) {
  const Scene& scene = solution.forest.scene();
  EnergyBalance balance;
  const std::vector<ElementId> leaves = solution.forest.AllLeaves();
  std::vector<double> cumulative;
  double flux = 0;
  for (const ElementId id : leaves) {
    const Element& element = solution.forest[id];
    const Material& material = scene.MaterialOf(element.patch);
    balance.emitted += element.area * material.emittance.sum();
    balance.absorbed += element.area * ((1 - material.reflectance) * solution.irradiance[id]).sum();
    flux += element.area * solution.radiosity[id].sum();
    cumulative.push_back(flux);
  }
  if (flux <= 0) return balance;

  const RayCaster caster(scene);
  enum : char { kFront, kBack, kAway };
  std::vector<char> fate(rays);
  ParallelFor(rays, kRayGrain, [&](std::size_t i) {
    const Ray ray = MakeRay(solution, leaves, cumulative, i, rays, seed);
    const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, solution.forest[ray.leaf].patch);
    fate[i] = hit.patch == kNoPatch ? kAway : hit.front ? kFront : kBack;
  });
  const double per_ray = flux / static_cast<double>(rays);
  balance.absorbed += per_ray * static_cast<double>(std::count(fate.begin(), fate.end(), kBack));
  balance.escaped = per_ray * static_cast<double>(std::count(fate.begin(), fate.end(), kAway));
  if (balance.emitted > 0)
    balance.relative_imbalance =
        std::abs(balance.emitted - balance.absorbed - balance.escaped) / balance.emitted;
  return balance;
}

}  // namespace penumbra
