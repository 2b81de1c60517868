#include "solver/transport/energy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/scene/surface_points.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/source_set.h"
#include "solver/visibility/ray_caster.h"

namespace penumbra {
namespace {

constexpr std::size_t kRayGrain = 1024;

// A polygon that sends out light.
struct Sender {
  PatchId patch;
  const SourceSet::Node* node;
};

struct Ray {
  PatchId patch;
  Vec3 origin, direction;
};

Vec3 CosineDirection(const Vec3& normal, double s, double t) {
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  const double radius = std::sqrt(s), angle = 2 * std::numbers::pi * t;
  return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v + std::sqrt(1 - s) * normal;
}

// The i-th ray of `count`, leaving the sender whose share of the flux covers (i + 1/2) / count.
Ray MakeRay(const Scene& scene, const std::vector<Sender>& senders, const std::vector<double>& cumulative,
            std::size_t i, std::size_t count, std::uint64_t seed, double lift) {
  const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * cumulative.back();
  const auto found = static_cast<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), at) -
                                              cumulative.begin());
  const Sender& sender = senders[std::min(found, senders.size() - 1)];
  std::array<double, 4> x;
  for (std::size_t d = 0; d < 4; ++d) x[d] = AdditiveRecurrence(i + 7919 * seed, kR4Alpha[d]);
  const std::span<const Vec3> polygon(sender.node->vertex.data(),
                                      static_cast<std::size_t>(sender.node->size));
  const Vec3& normal = scene.patches[sender.patch].normal;
  // What lies on the sender, looking the other way, neither lights nor blocks it.
  const Vec3 before = PointOn(polygon, x[0], x[1]) + lift * normal;
  return {sender.patch, before, CosineDirection(normal, x[2], x[3])};
}

}  // namespace

EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays, std::uint64_t seed) {
  const Scene& scene = solution.forest.scene();
  EnergyBalance balance;
  for (const ElementId id : solution.forest.AllLeaves()) {
    const Element& element = solution.forest[id];
    const Material& material = scene.MaterialOf(element.patch);
    balance.emitted += element.area * material.emittance.sum();
    balance.absorbed += element.area * ((1 - material.reflectance) * solution.irradiance[id]).sum();
  }

  const SourceSet sources = SourceSet::FromSolution(solution);
  std::vector<Sender> senders;
  std::vector<double> cumulative;
  double flux = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    for (const SourceSet::Node& node : sources.Tree(static_cast<PatchId>(p))) {
      if (node.skip != 1) continue;
      const std::span<const Vec3> polygon(node.vertex.data(), static_cast<std::size_t>(node.size));
      flux += VectorArea(polygon).norm() * node.radiosity.sum();
      senders.push_back({static_cast<PatchId>(p), &node});
      cumulative.push_back(flux);
    }
  if (flux <= 0 || rays == 0) return balance;

  const RayCaster caster(scene);
  const double lift = ContactGap(scene);
  enum : char { kFront, kBack, kAway };
  std::vector<char> fate(rays);
  ParallelFor(rays, kRayGrain, [&](std::size_t i) {
    const Ray ray = MakeRay(scene, senders, cumulative, i, rays, seed, lift);
    const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, ray.patch);
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
