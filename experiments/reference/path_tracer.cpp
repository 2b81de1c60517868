#include "experiments/reference/path_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/reference/scrambled_sobol.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

constexpr auto kCount = static_cast<std::size_t>(PathTracer::kReplicates);

// Samples of each kind in each replicate before the first look at the error, a power of two: few enough to
// cost nothing, enough to have met what there is to be met.
constexpr std::uint64_t kFirst = 512;

// Random numbers come from streams of their own for each point, kind and replicate.
enum Kind : std::uint64_t { kDirect, kIndirect, kTail, kKinds };
std::uint64_t Stream(std::uint64_t sequence, Kind kind, std::size_t replicate) {
  return (sequence * kKinds + kind) * kCount + replicate;
}

// A quantity estimated in replicates, each the mean of equally many samples.
struct Estimate {
  std::array<Rgb, kCount> sum;
  std::uint64_t samples = 0;  // in each replicate

  Estimate() { sum.fill(Rgb::Zero()); }
  Rgb Mean() const {
    Rgb mean = Rgb::Zero();
    for (const Rgb& s : sum) mean += s;
    return mean / static_cast<double>(samples * kCount);
  }
  // Of the mean.
  Rgb Variance() const {
    const Rgb mean = Mean();
    Rgb squares = Rgb::Zero();
    for (const Rgb& s : sum) squares += (s / static_cast<double>(samples) - mean).square();
    return squares / static_cast<double>(kCount * (kCount - 1));
  }
};

Vec3 ByCosine(const Frame& frame, double u, double v) {
  const double r = std::sqrt(u), angle = 2 * std::numbers::pi * v;
  return r * std::cos(angle) * frame.u + r * std::sin(angle) * frame.v + std::sqrt(1 - u) * frame.n;
}

}  // namespace

// What the estimate at one point goes on with.
struct PathTracer::Work {
  IrradiancePoint point;
  PlaneId plane = kNoPlane;
  Frame frame;
  std::vector<ScrambledSobol> direct_points, path_points;
  std::vector<Random> tails;  // what the Sobol points have no dimension for
  std::uint64_t rays = 0;
};

PathTracer::PathTracer(const Scene& scene, const PathTracerOptions& options)
    : scene_(scene), options_(options), rays_(scene), emitters_(scene) {}

Rgb PathTracer::Direct(const Vec3& at, PlaneId plane, const Vec3& normal, const std::array<double, 3>& random,
                       std::uint64_t& rays) const {
  const EmitterSample sample = emitters_.Sample(at, normal, random[0], random[1], random[2]);
  if (sample.patch == kNoPatch) return Rgb::Zero();
  const PlaneId emitter = rays_.PlaneOf(sample.patch);
  if (emitter == plane) return Rgb::Zero();
  ++rays;
  if (rays_.Blocked(at, plane, sample.position, emitter)) return Rgb::Zero();
  return sample.irradiance;
}

// One path: the irradiance that has been reflected at least once.
Rgb PathTracer::Indirect(Work& work, int replicate) const {
  const auto at = static_cast<std::size_t>(replicate);
  const ScrambledSobol::Point point = work.path_points[at].Next();
  Random& tail = work.tails[at];
  std::size_t used = 0;
  const auto next = [&] { return used < point.size() ? point[used++] : tail.Uniform(); };

  Rgb carried = Rgb::Ones(), sum = Rgb::Zero();
  Vec3 position = work.point.position;
  Frame frame = work.frame;
  PlaneId plane = work.plane;
  for (;;) {
    const double u = next(), v = next();
    ++work.rays;
    const RayScene::Hit hit = rays_.Trace(position, plane, ByCosine(frame, u, v));
    if (hit.patch == kNoPatch || !hit.front) return sum;
    const Patch& patch = scene_.patches[static_cast<std::size_t>(hit.patch)];
    carried *= scene_.materials[static_cast<std::size_t>(patch.material)].reflectance;
    const double most = carried.maxCoeff();
    if (most <= 0) return sum;
    if (most < options_.roulette) {
      if (tail.Uniform() * options_.roulette >= most) return sum;
      carried *= options_.roulette / most;
    }
    position = hit.position;
    plane = rays_.PlaneOf(hit.patch);
    const double c = next(), a = next(), b = next();
    sum += carried * Direct(position, plane, patch.normal, {c, a, b}, work.rays);
    frame = MakeFrame(position, patch.normal);
  }
}

ReferenceIrradiance PathTracer::At(const IrradiancePoint& point, std::uint64_t sequence) const {
  Work work;
  work.point = point;
  work.plane = rays_.PlaneAt(point.position);
  work.frame = MakeFrame(point.position, point.normal);
  for (std::size_t r = 0; r < kCount; ++r) {
    work.direct_points.emplace_back(options_.seed, Stream(sequence, kDirect, r));
    work.path_points.emplace_back(options_.seed, Stream(sequence, kIndirect, r));
    work.tails.emplace_back(options_.seed, Stream(sequence, kTail, r));
  }
  ReferenceIrradiance result;
  if (emitters_.empty()) return result;

  Estimate direct, indirect;
  std::uint64_t direct_rays = 0;
  const auto add_direct = [&](std::uint64_t samples) {
    for (std::size_t r = 0; r < kCount; ++r)
      for (std::uint64_t i = 0; i < samples; ++i) {
        const ScrambledSobol::Point s = work.direct_points[r].Next();
        direct.sum[r] += Direct(point.position, work.plane, point.normal, {s[0], s[1], s[2]}, direct_rays);
      }
    direct.samples += samples;
  };
  const auto add_indirect = [&](std::uint64_t samples) {
    for (std::size_t r = 0; r < kCount; ++r)
      for (std::uint64_t i = 0; i < samples; ++i) indirect.sum[r] += Indirect(work, static_cast<int>(r));
    indirect.samples += samples;
  };
  add_direct(kFirst);
  add_indirect(kFirst);
  // Doubles whichever estimate takes away more variance for a ray, until the sum is good enough: 2^k points
  // of the sequence lie evenly, other numbers do not.
  for (;;) {
    const Rgb direct_variance = direct.Variance(), variance = indirect.Variance();
    result.direct = direct.Mean();
    result.total = result.direct + indirect.Mean();
    result.direct_error = direct_variance.sqrt();
    result.error = (direct_variance + variance).sqrt();
    if ((result.error <= options_.target * result.total).all()) break;
    Eigen::Index channel = 0;
    (result.error / result.total.max(1e-300)).maxCoeff(&channel);
    const double gain = direct_variance[channel] / static_cast<double>(direct_rays + 1);
    if (gain > variance[channel] / static_cast<double>(work.rays + 1)) {
      if (2 * direct.samples * kCount > options_.max_paths) break;
      add_direct(direct.samples);
    } else {
      if (2 * indirect.samples * kCount > options_.max_paths) break;
      add_indirect(indirect.samples);
    }
  }
  result.paths = indirect.samples * kCount;
  result.direct_samples = direct.samples * kCount;
  result.rays = work.rays + direct_rays;
  return result;
}

std::vector<ReferenceIrradiance> PathTracer::At(const std::vector<IrradiancePoint>& points,
                                                const ExecutionContext& context) const {
  std::vector<ReferenceIrradiance> result(points.size());
  ParallelFor(points.size(), 1, [&](std::size_t i) {
    if (!context.Cancelled()) result[i] = At(points[i], i);
  });
  if (context.Cancelled()) return {};
  return result;
}

}  // namespace penumbra
