#include "solver/transport/points/final_gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/geometry/polygon.h"
#include "solver/transport/links/element_locator.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {

namespace {

// A leaf is a luminaire if it reflects this times as much as surfaces on average.
constexpr double kBright = 6;
// The direction of a second ray is that of the first one, this many places on: a prime, so that the two do
// not look alike.
constexpr std::size_t kStride = 7919;
// A surface stands on a point if it crosses one of kLooksAround short segments from the point, kAside times
// RayLift() long.
constexpr int kLooksAround = 8;
constexpr double kAside = 4;
// Light that differs by more than this factor between leaves that touch is not smooth.
constexpr double kSharpEdge = 2;
// The largest number of leaves that are luminaires; points look at all of them.
constexpr std::size_t kMostReflectors = 2000;

std::vector<Rgb> ReflectedOf(const RadiositySolution& solution) {
  std::vector<Rgb> reflected;
  reflected.reserve(solution.forest.size());
  for (std::size_t e = 0; e < solution.forest.size(); ++e)
    reflected.push_back(solution.forest.scene().MaterialOf(solution.forest.elements()[e].patch).reflectance *
                        solution.irradiance[e]);
  return reflected;
}

// Moves the leaves that reflect most from `reflected`, where they leave zeros, to a list.
std::vector<BrightReflector> TakeBrightest(const ElementForest& forest, std::vector<Rgb>& reflected) {
  double flux = 0, area = 0;
  std::vector<ElementId> bright;
  const std::vector<ElementId> leaves = forest.AllLeaves();
  const auto power = [&](ElementId leaf) {
    return forest[leaf].area * reflected[static_cast<std::size_t>(leaf)].maxCoeff();
  };
  for (const ElementId leaf : leaves) {
    flux += power(leaf);
    area += forest[leaf].area;
  }
  for (const ElementId leaf : leaves)
    if (power(leaf) * area > kBright * flux * forest[leaf].area) bright.push_back(leaf);
  std::stable_sort(bright.begin(), bright.end(),
                   [&](ElementId a, ElementId b) { return power(a) > power(b); });
  if (bright.size() > kMostReflectors) bright.resize(kMostReflectors);
  std::vector<BrightReflector> taken;
  for (const ElementId leaf : bright) {
    const std::span<const Vec3> polygon = forest[leaf].Vertices();
    taken.push_back({forest[leaf].patch, Polygon3(polygon.begin(), polygon.end()),
                     std::exchange(reflected[static_cast<std::size_t>(leaf)], Rgb::Zero())});
  }
  return taken;
}

// The light at the corners of a leaf [W/m^2].
struct CornerLight {
  std::array<Rgb, 4> light;
  bool is_triangle = false;
};

// The light at the corners of all leaves: the area-weighted mean over the leaves of the patch that meet
// there, except those whose light differs so much that a shadow's edge or a wall must lie between, or that
// are dark because they have become luminaires.
std::vector<CornerLight> LightAtCorners(const ElementForest& forest, std::span<const Rgb> light) {
  std::vector<CornerLight> corners(forest.size());
  const std::size_t patches = forest.scene().patches.size();
  ParallelFor(patches, 16, [&](std::size_t p) {
    std::unordered_map<LatticePoint, std::vector<ElementId>, LatticePointHash> meeting;
    const std::vector<ElementId> leaves = forest.Leaves(static_cast<PatchId>(p));
    for (const ElementId leaf : leaves) {
      if ((light[static_cast<std::size_t>(leaf)] <= 0).all()) continue;
      for (const LatticePoint& corner : forest[leaf].Corners()) meeting[corner].push_back(leaf);
    }
    for (const ElementId leaf : leaves) {
      CornerLight& own = corners[static_cast<std::size_t>(leaf)];
      const Rgb& of_leaf = light[static_cast<std::size_t>(leaf)];
      own.is_triangle = forest[leaf].size == 3;
      own.light.fill(of_leaf);
      if ((of_leaf <= 0).all()) continue;
      for (std::size_t k = 0; k < forest[leaf].Corners().size(); ++k) {
        Rgb sum = Rgb::Zero();
        double area = 0;
        for (const ElementId other : meeting[forest[leaf].Corners()[k]]) {
          const Rgb& of_other = light[static_cast<std::size_t>(other)];
          if (of_other.sum() > kSharpEdge * of_leaf.sum() || of_leaf.sum() > kSharpEdge * of_other.sum())
            continue;
          sum += forest[other].area * of_other;
          area += forest[other].area;
        }
        own.light[k] = sum / area;
      }
    }
  });
  return corners;
}

}  // namespace

struct FinalGather::Shared {
  explicit Shared(const RadiositySolution& solution)
      : scene(solution.forest.scene()),
        elements(solution.forest),
        caster(scene),
        lift(RayLift(scene)),
        reflected(ReflectedOf(solution)),
        dim(reflected),
        luminaires(scene, caster, TakeBrightest(solution.forest, dim)),
        emitters(scene, caster),
        at_corners(LightAtCorners(solution.forest, dim)) {}

  // The dim reflected radiosity at a place: linear or bilinear between the corners of its leaf.
  Rgb DimAt(const ElementLocator::Place& place) const {
    const CornerLight& corner = at_corners[static_cast<std::size_t>(place.element)];
    const double s = std::clamp(place.s, 0.0, 1.0), t = std::clamp(place.t, 0.0, 1.0);
    if (corner.is_triangle) return (1 - s - t) * corner.light[0] + s * corner.light[1] + t * corner.light[2];
    return (1 - t) * ((1 - s) * corner.light[0] + s * corner.light[1]) +
           t * ((1 - s) * corner.light[3] + s * corner.light[2]);
  }

  const Scene& scene;
  ElementLocator elements;
  RayCaster caster;
  double lift;                 // RayLift()
  std::vector<Rgb> reflected;  // radiosity without emittance, by element [W/m^2]
  std::vector<Rgb> dim;        // the same, but zero for leaves that are luminaires
  ShadowRays luminaires, emitters;
  std::vector<CornerLight> at_corners;  // of leaves, by element
};

FinalGather::FinalGather(const RadiositySolution& solution, const FinalGatherOptions& options)
    : FinalGather(std::make_shared<const Shared>(solution), options) {}

FinalGather::FinalGather(std::shared_ptr<const Shared> shared, const FinalGatherOptions& options)
    : shared_(std::move(shared)), options_(options) {
  MakeDirections();
}

FinalGather FinalGather::With(const FinalGatherOptions& options) const { return {shared_, options}; }

void FinalGather::MakeDirections() {
  const double turn = AdditiveRecurrence(options_.seed, kR4Alpha[0]),
               shift = AdditiveRecurrence(options_.seed, kR4Alpha[1], 0);
  const auto count = static_cast<double>(options_.rays);
  for (std::size_t k = 0; k < options_.rays; ++k) {
    const double s = std::fmod((static_cast<double>(k) + 0.5) / count + shift, 1.0);
    const double angle = 2 * std::numbers::pi * AdditiveRecurrence(k, std::numbers::phi, turn);
    const double radius = std::sqrt(s);
    directions_.emplace_back(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - s));
  }
}

Rgb FinalGather::RadiosityAt(PatchId patch, const Vec3& point, std::size_t ray) const {
  const Shared& in = *shared_;
  const ElementLocator::Place place = in.elements.Find(patch, point);
  if (!options_.regather || (in.dim[static_cast<std::size_t>(place.element)] <= 0).all())
    return in.DimAt(place);
  const Patch& hit = in.scene.patches[static_cast<std::size_t>(patch)];
  const Rgb& reflectance = in.scene.MaterialOf(patch).reflectance;
  if ((reflectance <= 0).all()) return Rgb::Zero();
  const ReceiverPoint at{.position = point, .normal = hit.normal, .approach = hit.normal};
  const ShadowRayEffort effort{.divisions = 0,
                               .closer_above = std::numeric_limits<double>::infinity(),
                               .seed = options_.shadows.seed + ray};
  Rgb irradiance = in.emitters.At(at, effort);
  const Frame frame = MakeFrame(Vec3::Zero(), hit.normal);
  const Vec3& local = directions_[(ray * kStride) % directions_.size()];
  const Vec3 direction = local.x() * frame.u + local.y() * frame.v + local.z() * frame.n;
  const Vec3 start = RayStart(at, in.lift);
  const RayCaster::Hit next = in.caster.Cast(start, direction);
  if (next.patch != kNoPatch && next.front)
    irradiance += in.reflected[static_cast<std::size_t>(
        in.elements.LeafAt(next.patch, start + next.distance * direction))];
  return reflectance * irradiance;
}

std::uint32_t FinalGather::AreOneSided(std::span<const ReceiverPoint> points) const {
  PENUMBRA_CHECK(points.size() <= kTogether);
  if (points.empty()) return 0;
  const Shared& in = *shared_;
  const Frame frame = MakeFrame(Vec3::Zero(), points[0].normal);
  std::array<Vec3, kTogether> from, to;
  const std::size_t count = points.size();
  std::uint32_t one_sided = 0;
  for (int k = 0; k < kLooksAround; ++k) {
    const double angle = 2 * std::numbers::pi * k / kLooksAround;
    const Vec3 aside = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
    for (std::size_t i = 0; i < count; ++i) {
      from[i] = points[i].position + in.lift * points[i].normal;
      to[i] = from[i] + kAside * in.lift * aside;
    }
    if (count == 1)
      one_sided |= in.caster.Blocked(from[0], to[0]) ? 1 : 0;
    else
      one_sided |= in.caster.BlockedTogether(std::span(from).first(count), std::span(to).first(count));
  }
  return one_sided;
}

// Adds the light that dim surfaces reflect to the points. `parts`, unless null, is that of the first point.
void FinalGather::AddReflected(std::span<const ReceiverPoint> points, std::span<Rgb> irradiance,
                               IrradianceParts* parts) const {
  const Shared& in = *shared_;
  const Frame frame = MakeFrame(Vec3::Zero(), points[0].normal);
  std::array<Vec3, kTogether> starts;
  std::array<RayCaster::Hit, kTogether> hits;
  std::array<Rgb, kTogether> reflected;
  reflected.fill(Rgb::Zero());
  const std::size_t count = points.size();
  for (std::size_t i = 0; i < count; ++i) starts[i] = RayStart(points[i], in.lift);
  const double each = 1 / static_cast<double>(directions_.size());
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const Vec3& local = directions_[k];
    const Vec3 direction = local.x() * frame.u + local.y() * frame.v + local.z() * frame.n;
    if (count == 1)  // a packet of one ray is slower
      hits[0] = in.caster.Cast(starts[0], direction);
    else
      in.caster.CastTogether(std::span(starts).first(count), direction, std::span(hits).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const RayCaster::Hit& hit = hits[i];
      if (hit.patch == kNoPatch || !hit.front) continue;
      const Rgb radiosity = RadiosityAt(hit.patch, starts[i] + hit.distance * direction, k);
      reflected[i] += radiosity;
      if (parts && i == 0 && (radiosity > 0).any())
        parts->contributions.push_back({hit.patch, each * radiosity});
    }
  }
  for (std::size_t i = 0; i < count; ++i) irradiance[i] += each * reflected[i];
}

Rgb FinalGather::At(const ReceiverPoint& at, IrradianceParts* parts) const {
  Rgb irradiance = shared_->luminaires.At(at, options_.shadows, parts);
  AddReflected({&at, 1}, {&irradiance, 1}, parts);
  return irradiance;
}

void FinalGather::AtAll(std::span<const ReceiverPoint> points, std::span<Rgb> irradiance) const {
  PENUMBRA_CHECK(points.size() <= kTogether && irradiance.size() == points.size());
  if (points.empty()) return;
  shared_->luminaires.AtAll(points, options_.shadows, irradiance);
  AddReflected(points, irradiance, nullptr);
}

}  // namespace penumbra
