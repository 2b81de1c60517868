#include "solver/transport/solvers/stochastic_solver.h"

#include <algorithm>
#include <cmath>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/transport/points/diffuse_rays.h"
#include "solver/transport/points/ray_ends.h"

namespace penumbra {
namespace {

constexpr std::size_t kBundles = 16;
constexpr std::size_t kRaysOfElement = 64;  // of a bundle, on the average over the elements
// A bounce casts at least this part of the bundle's rays, so that late bounces are no rougher than they need.
constexpr double kLeastPart = 1.0 / 16;
constexpr std::size_t kTraceGrain = 8;

}  // namespace

StochasticSolver::StochasticSolver(const Scene& scene, const PatchVisibility& visibility,
                                   const UniformOptions& options, const ExecutionContext& context)
    : UniformSolver(scene, visibility, options, kBundles),
      bundles_(options.shots > 0 ? options.shots : kBundles),
      rays_(options.form_factor_options.rays > 0 ? options.form_factor_options.rays
                                                 : kRaysOfElement * leaves().size()),
      caster_(scene),
      locator_(forest()),
      place_(forest().size(), -1),
      used_(leaves().size(), 0),
      sum_(leaves().size(), Rgb::Zero()),
      squares_(leaves().size(), Rgb::Zero()) {
  for (std::size_t i = 0; i < leaves().size(); ++i)
    place_[static_cast<std::size_t>(leaves()[i])] = static_cast<std::int32_t>(i);
  if (!context.Cancelled()) SetReady();
}

// The number of rays of each leaf, in proportion to its flux over all channels; rounded up or down by one
// random number for all, so that each is right on the average.
std::vector<std::uint32_t> StochasticSolver::ShareOut(std::span<const Rgb> flux, double rays,
                                                      std::uint64_t turn) const {
  double whole = 0;
  for (const Rgb& f : flux) whole += f.sum();
  std::vector<std::uint32_t> share(flux.size(), 0);
  double reached = Random(options().form_factor_options.seed, turn).Uniform();
  for (std::size_t i = 0; i < flux.size() && whole > 0; ++i) {
    const double next = reached + rays * flux[i].sum() / whole;
    share[i] = static_cast<std::uint32_t>(std::floor(next) - std::floor(reached));
    reached = next;
  }
  return share;
}

// The flux that arrives at each leaf.
std::vector<Rgb> StochasticSolver::Bounce(std::span<const Rgb> flux, double rays,
                                          std::vector<std::size_t>* used,
                                          const ExecutionContext& context) const {
  double whole = 0;
  for (const Rgb& f : flux) whole += f.sum();
  std::uint64_t turn = 0;
  for (const std::size_t count : *used) turn += count;
  const std::vector<std::uint32_t> share = ShareOut(flux, rays, turn);
  const double lift = RayLift(scene());
  const std::uint64_t seed = options().form_factor_options.seed;
  std::vector<std::vector<std::int32_t>> hits(flux.size());
  ParallelFor(flux.size(), kTraceGrain, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const Element& element = forest()[leaves()[i]];
    const Vec3& normal = scene().patches[static_cast<std::size_t>(element.patch)].normal;
    for (std::uint32_t k = 0; k < share[i]; ++k) {
      const DiffuseRay ray =
          MakeDiffuseRay(element.Vertices(), normal, lift, (*used)[i] + k, i + flux.size() * seed);
      const RayCaster::Hit hit = caster_.Cast(ray.origin, ray.direction);
      if (hit.patch == kNoPatch || !hit.front) continue;
      const ElementId leaf = locator_.LeafAt(hit.patch, ray.origin + hit.distance * ray.direction);
      hits[i].push_back(place_[static_cast<std::size_t>(leaf)]);
    }
  });
  std::vector<Rgb> arrived(flux.size(), Rgb::Zero());
  for (std::size_t i = 0; i < flux.size(); ++i) {
    (*used)[i] += share[i];
    if (hits[i].empty()) continue;
    // The flux of a ray: the leaf's colours, and the same sum over the channels for all rays.
    const Rgb of_ray = flux[i] * (whole / (rays * flux[i].sum()));
    for (const std::int32_t target : hits[i]) arrived[static_cast<std::size_t>(target)] += of_ray;
  }
  return arrived;
}

double StochasticSolver::RelativeError() const {
  const auto count = static_cast<double>(report().iterations.size() + 1);
  if (count < 2) return 1;
  double variance = 0, square = 0;
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    const Rgb mean = sum_[i] / count;
    variance += AreaOf(i) * ((squares_[i] / count - mean.square()).max(0.0) / (count - 1)).sum();
    square += AreaOf(i) * mean.square().sum();
  }
  return square > 0 ? std::sqrt(variance / square) : 0;
}

bool StochasticSolver::Advance(IterationReport* report, const ExecutionContext& context) {
  std::vector<Rgb> flux(leaves().size()), irradiance(leaves().size(), Rgb::Zero());
  std::vector<std::size_t> used = used_;
  double emitted = 0;
  for (std::size_t i = 0; i < flux.size(); ++i) {
    flux[i] = AreaOf(i) * MaterialOf(i).emittance;
    emitted += flux[i].sum();
  }
  double left = emitted;
  while (left > options().relative_cutoff * emitted) {
    const double rays = std::max(
        1.0, std::ceil(static_cast<double>(rays_) * std::max(kLeastPart, std::min(1.0, left / emitted))));
    const std::vector<Rgb> arrived = Bounce(flux, rays, &used, context);
    if (context.Cancelled()) return false;
    left = 0;
    for (std::size_t i = 0; i < flux.size(); ++i) {
      irradiance[i] += arrived[i] / AreaOf(i);
      flux[i] = MaterialOf(i).reflectance * arrived[i];
      left += flux[i].sum();
    }
    ++report->sweeps;
  }
  used_ = std::move(used);
  const auto count = static_cast<double>(this->report().iterations.size() + 1);
  std::vector<Rgb> mean(sum_.size());
  for (std::size_t i = 0; i < sum_.size(); ++i) {
    sum_[i] += irradiance[i];
    squares_[i] += irradiance[i].square();
    mean[i] = sum_[i] / count;
  }
  report->residual = RelativeError();
  Show(mean);
  return true;
}

LightSolverRegistry::Method StochasticSolverMethod() {
  return {"stochastic",
          "Monte Carlo radiosity: bundles of rays of equal flux, bounce after bounce (Neumann et al. 1995)",
          {"divisions", "relative-cutoff", "rays", "shots"},
          MakeUniformSolver<StochasticSolver>};
}

}  // namespace penumbra
