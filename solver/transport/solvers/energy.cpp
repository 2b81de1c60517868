#include "solver/transport/solvers/energy.h"

#include <algorithm>
#include <cmath>

#include "solver/base/parallel.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/points/diffuse_rays.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {
namespace {

constexpr std::size_t kRayGrain = 1024;

// A polygon that sends light.
struct Sender {
  PatchId patch;
  const SourceSet::Node* node;
};

// The sender whose interval of the cumulative flux contains the fraction (i + 1/2) / count.
const Sender& SenderOfRay(const std::vector<Sender>& senders, const std::vector<double>& cumulative,
                          std::size_t i, std::size_t count) {
  const double at = (static_cast<double>(i) + 0.5) / static_cast<double>(count) * cumulative.back();
  const auto found = static_cast<std::size_t>(std::upper_bound(cumulative.begin(), cumulative.end(), at) -
                                              cumulative.begin());
  return senders[std::min(found, senders.size() - 1)];
}

}  // namespace

EnergyBalance MeasureEnergy(const RadiositySolution& solution, std::size_t rays, std::uint64_t seed,
                            const ExecutionContext& context) {
  const Scene& scene = solution.forest.scene();
  EnergyBalance balance;
  for (const ElementId id : solution.forest.AllLeaves()) {
    const Element& element = solution.forest[id];
    const Material& material = scene.MaterialOf(element.patch);
    balance.emitted += element.area * material.emittance.sum();
    balance.absorbed += element.area * ((1 - material.reflectance) * solution.irradiance[id]).sum();
  }

  if (context.Cancelled()) return balance;
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
    if (context.Cancelled()) return;
    const Sender& sender = SenderOfRay(senders, cumulative, i, rays);
    const std::span<const Vec3> polygon(sender.node->vertex.data(),
                                        static_cast<std::size_t>(sender.node->size));
    const DiffuseRay ray = MakeDiffuseRay(polygon, scene.patches[sender.patch].normal, lift, i, seed);
    const RayCaster::Hit hit = caster.Cast(ray.origin, ray.direction, sender.patch);
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
