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
#include "solver/transport/links/fragment_locator.h"
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
// Points look for luminaires together with their neighbours in a cube of this times the side of a mean leaf.
constexpr double kRegion = 8;
// The largest number of leaves that are luminaires; points look at all of them.
constexpr std::size_t kMostReflectors = 2000;

// Radiosity without emittance [W/m^2].
struct Reflected {
  std::vector<Rgb> element, fragment;
};

Reflected ReflectedOf(const RadiositySolution& solution) {
  Reflected reflected;
  reflected.element.reserve(solution.forest.size());
  const auto reflectance = [&](ElementId element) {
    return solution.forest.scene().MaterialOf(solution.forest[element].patch).reflectance;
  };
  for (std::size_t e = 0; e < solution.forest.size(); ++e)
    reflected.element.push_back(reflectance(static_cast<ElementId>(e)) * solution.irradiance[e]);
  for (const Fragment& fragment : solution.fragments)
    reflected.fragment.push_back(reflectance(fragment.leaf) * fragment.irradiance);
  return reflected;
}

// A leaf that is whole, or a fragment, with the light that it reflects.
struct LitCell {
  ElementId leaf = kNoElement;
  std::span<const Vec3> polygon;
  double area = 0;           // [m^2]
  Rgb* reflected = nullptr;  // [W/m^2]

  double Power() const { return area * reflected->maxCoeff(); }
};

std::vector<LitCell> LitCellsOf(const RadiositySolution& solution, Reflected& reflected) {
  std::vector<LitCell> cells;
  const FragmentLocator fragments(solution);
  for (const ElementId leaf : solution.forest.AllLeaves()) {
    const Element& element = solution.forest[leaf];
    if (fragments.IsWhole(leaf))
      cells.push_back(
          {leaf, element.Vertices(), element.area, &reflected.element[static_cast<std::size_t>(leaf)]});
    for (std::int32_t f = fragments.FirstOf(leaf); f < fragments.FirstOf(leaf + 1); ++f) {
      const Fragment& fragment = solution.fragments[static_cast<std::size_t>(f)];
      cells.push_back(
          {leaf, fragment.polygon, fragment.area, &reflected.fragment[static_cast<std::size_t>(f)]});
    }
  }
  return cells;
}

// Moves the cells that reflect most from `reflected`, where they leave zeros, to a list.
std::vector<BrightReflector> TakeBrightest(const RadiositySolution& solution, Reflected& reflected) {
  double flux = 0, area = 0;
  const std::vector<LitCell> cells = LitCellsOf(solution, reflected);
  for (const LitCell& cell : cells) {
    flux += cell.Power();
    area += cell.area;
  }
  std::vector<LitCell> bright;
  for (const LitCell& cell : cells)
    if (cell.Power() * area > kBright * flux * cell.area) bright.push_back(cell);
  std::stable_sort(bright.begin(), bright.end(),
                   [](const LitCell& a, const LitCell& b) { return a.Power() > b.Power(); });
  if (bright.size() > kMostReflectors) bright.resize(kMostReflectors);
  std::vector<BrightReflector> taken;
  for (const LitCell& cell : bright) {
    const PatchId patch = solution.forest[cell.leaf].patch;
    const Rgb radiosity = std::exchange(*cell.reflected, Rgb::Zero());
    // Quadrilaterals of a fan, and a triangle if the number of vertices is odd.
    for (std::size_t k = 1; k + 1 < cell.polygon.size(); k += 2) {
      Polygon3 piece = {cell.polygon[0], cell.polygon[k], cell.polygon[k + 1]};
      if (k + 2 < cell.polygon.size()) piece.push_back(cell.polygon[k + 2]);
      taken.push_back({patch, std::move(piece), radiosity});
    }
  }
  return taken;
}

// The light at the corners of a leaf [W/m^2].
struct CornerLight {
  std::array<Rgb, 4> light;
  bool is_triangle = false;
};

// A leaf or a fragment at a corner of the lattice.
struct AtCorner {
  Rgb light = Rgb::Zero();  // [W/m^2]
  double area = 0;          // [m^2]
};
using MeetingAtCorners = std::unordered_map<LatticePoint, std::vector<AtCorner>, LatticePointHash>;

// What meets at the corners of a patch's leaves, without what is dark.
MeetingAtCorners FindMeeting(const RadiositySolution& solution, std::span<const ElementId> leaves,
                             const FragmentLocator& fragments, const Reflected& light) {
  MeetingAtCorners meeting;
  for (const ElementId leaf : leaves) {
    const Element& element = solution.forest[leaf];
    for (std::size_t k = 0; k < element.Corners().size(); ++k) {
      AtCorner at{light.element[static_cast<std::size_t>(leaf)], element.area};
      if (const std::int32_t f = fragments.At(leaf, element.vertex[k]); f >= 0)
        at = {light.fragment[static_cast<std::size_t>(f)],
              solution.fragments[static_cast<std::size_t>(f)].area};
      if ((at.light > 0).any()) meeting[element.corner[k]].push_back(at);
    }
  }
  return meeting;
}

// The light at the corners of all whole leaves: the area-weighted mean over the leaves and fragments of the
// patch that meet there, except those whose light differs so much that a shadow's edge or a wall must lie
// between, or that are dark because they have become luminaires.
std::vector<CornerLight> LightAtCorners(const RadiositySolution& solution, const FragmentLocator& fragments,
                                        const Reflected& light) {
  const ElementForest& forest = solution.forest;
  std::vector<CornerLight> corners(forest.size());
  const std::size_t patches = forest.scene().patches.size();
  ParallelFor(patches, 16, [&](std::size_t p) {
    const std::vector<ElementId> leaves = forest.Leaves(static_cast<PatchId>(p));
    MeetingAtCorners meeting = FindMeeting(solution, leaves, fragments, light);
    for (const ElementId leaf : leaves) {
      CornerLight& own = corners[static_cast<std::size_t>(leaf)];
      const Rgb& of_leaf = light.element[static_cast<std::size_t>(leaf)];
      own.is_triangle = forest[leaf].size == 3;
      own.light.fill(of_leaf);
      if ((of_leaf <= 0).all() || !fragments.IsWhole(leaf)) continue;
      for (std::size_t k = 0; k < forest[leaf].Corners().size(); ++k) {
        Rgb sum = Rgb::Zero();
        double area = 0;
        for (const AtCorner& other : meeting[forest[leaf].corner[k]]) {
          if (other.light.sum() > kSharpEdge * of_leaf.sum() ||
              of_leaf.sum() > kSharpEdge * other.light.sum())
            continue;
          sum += other.area * other.light;
          area += other.area;
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
        fragments(solution),
        caster(scene),
        lift(RayLift(scene)),
        reflected(ReflectedOf(solution)),
        dim(reflected),
        luminaires(scene, caster, TakeBrightest(solution, dim)),
        emitters(scene, caster),
        at_corners(LightAtCorners(solution, fragments, dim)) {
    LearnWhatIsHidden(solution.forest);
  }

  // Lets the centres of leaves look for luminaires.
  void LearnWhatIsHidden(const ElementForest& forest) {
    std::vector<ReceiverPoint> points;
    double area = 0;
    for (const ElementId leaf : forest.AllLeaves()) {
      const Element& element = forest[leaf];
      const Vec3& normal = scene.patches[static_cast<std::size_t>(element.patch)].normal;
      points.push_back({.position = Centroid(element.Vertices()), .normal = normal, .approach = normal});
      area += element.area;
    }
    if (points.empty()) return;
    const double side = kRegion * std::sqrt(area / static_cast<double>(points.size()));
    luminaires.Learn(points, side);
    emitters.Learn(points, side);
  }

  // The light of the fragment, or of the whole element if `fragment` is negative.
  static const Rgb& Of(const Reflected& light, ElementId element, std::int32_t fragment) {
    return fragment >= 0 ? light.fragment[static_cast<std::size_t>(fragment)]
                         : light.element[static_cast<std::size_t>(element)];
  }

  // The dim reflected radiosity at a place of a whole leaf: linear or bilinear between its corners.
  Rgb DimAt(const ElementLocator::Place& place) const {
    const CornerLight& corner = at_corners[static_cast<std::size_t>(place.element)];
    const double s = std::clamp(place.s, 0.0, 1.0), t = std::clamp(place.t, 0.0, 1.0);
    if (corner.is_triangle) return (1 - s - t) * corner.light[0] + s * corner.light[1] + t * corner.light[2];
    return (1 - t) * ((1 - s) * corner.light[0] + s * corner.light[1]) +
           t * ((1 - s) * corner.light[3] + s * corner.light[2]);
  }

  const Scene& scene;
  ElementLocator elements;
  FragmentLocator fragments;
  RayCaster caster;
  double lift;  // RayLift()
  Reflected reflected;
  Reflected dim;  // the same, but zero for leaves and fragments that are luminaires
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
  const std::int32_t fragment = in.fragments.At(place.element, point);
  const Rgb& dim = Shared::Of(in.dim, place.element, fragment);
  if (!options_.regather || (dim <= 0).all()) return fragment >= 0 ? dim : in.DimAt(place);
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
  if (next.patch != kNoPatch && next.front) {
    const Vec3 end = start + next.distance * direction;
    const ElementId leaf = in.elements.LeafAt(next.patch, end);
    irradiance += Shared::Of(in.reflected, leaf, in.fragments.At(leaf, end));
  }
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
