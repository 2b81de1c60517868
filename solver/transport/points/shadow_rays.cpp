#include "solver/transport/points/shadow_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/base/scratch.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// A luminaire is strong if its unoccluded light is at least this times that of all.
constexpr double kStrong = 0.05;
// Farther than this times its radius, the sum over rays tells the light of a reflector to a per cent.
constexpr double kFarFromReflector = 4;

std::vector<PatchId> EveryPatch(const Scene& scene) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

// The light that has been found so far.
struct ShadowRays::Gathered {
  Rgb light = Rgb::Zero();
  double unoccluded = 0;  // of all luminaires, estimated in the brightest channel [W/m^2]
  IrradianceParts* parts = nullptr;

  void Add(PatchId patch, bool emits, const Rgb& irradiance) {
    light += irradiance;
    if (!parts || !(irradiance > 0).any()) return;
    parts->contributions.push_back({patch, irradiance});
    if (emits) parts->direct += irradiance;
  }
};

ShadowRays::ShadowRays(const Scene& scene, const RayCaster& caster,
                       std::span<const BrightReflector> reflectors)
    : scene_(scene),
      caster_(caster),
      lift_(RayLift(scene)),
      sources_(SourceSet::Emitters(scene)),
      patches_(scene, EveryPatch(scene)) {
  for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); ++p)
    if (!sources_.Tree(p).empty())
      AddLuminaire(p, scene.patches[static_cast<std::size_t>(p)].Vertices(), sources_.Emittance(p), true);
  for (const BrightReflector& r : reflectors) AddLuminaire(r.patch, r.polygon, r.radiosity, false);
}

void ShadowRays::AddLuminaire(PatchId patch, std::span<const Vec3> polygon, const Rgb& radiosity,
                              bool emits) {
  PENUMBRA_CHECK(polygon.size() == 3 || polygon.size() == 4);
  Luminaire added{};
  added.patch = patch;
  added.emits = emits;
  added.size = polygon.size();
  std::copy(polygon.begin(), polygon.end(), added.vertex.begin());
  added.normal = scene_.patches[static_cast<std::size_t>(patch)].normal;
  added.area = VectorArea(polygon).norm();
  added.centre = Vec3::Zero();
  for (const Vec3& v : polygon) added.centre += v / static_cast<double>(polygon.size());
  for (const Vec3& v : polygon) added.radius = std::max(added.radius, (v - added.centre).norm());
  added.radiosity = radiosity;
  added.brightness = radiosity.maxCoeff();
  luminaires_.push_back(added);
}

// Lists the luminaires that lie before the point, and before which the point lies, in descending order of
// light.
void ShadowRays::FindSeen(const ReceiverPoint& at, std::vector<Seen>& seen) const {
  for (std::size_t i = 0; i < luminaires_.size(); ++i) {
    const Luminaire& luminaire = luminaires_[i];
    const Vec3 to = luminaire.centre - at.position;
    const double high = at.normal.dot(to) + luminaire.radius, deep = -luminaire.normal.dot(to);
    // What lies in the plane of a reflector gets none of its light.
    if (high <= 0 || deep < (luminaire.emits ? -lift_ : lift_)) continue;
    const double distance = std::max(to.norm(), luminaire.radius);
    // Near a large luminaire, parts of it are seen much less obliquely than its centre.
    const double bulge = luminaire.radius * luminaire.radius / distance;
    const double cosines = std::min(1.0, high / distance) * std::min(1.0, (deep + bulge) / distance);
    seen.push_back({luminaire.brightness *
                        std::min(1.0, luminaire.area * cosines / (std::numbers::pi * distance * distance)),
                    i});
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.light > b.light; });
}

namespace {

// The light that a small piece of surface at `to` sends, without blockers and constant factors.
double Kernel(const ReceiverPoint& at, const Vec3& normal, const Vec3& to) {
  const Vec3 d = to - at.position;
  const double r2 = d.squaredNorm(), cosines = at.normal.dot(d) * -normal.dot(d);
  return at.normal.dot(d) > 0 && cosines > 0 ? cosines / (r2 * r2) : 0;
}

}  // namespace

// Follows rays to the same place in each of divisions^2 cells of the luminaire.
ShadowRays::RaySums ShadowRays::CastRays(const Vec3& from, const ReceiverPoint& at,
                                         const Luminaire& luminaire, const ShadowRayEffort& effort) const {
  const int divisions = effort.divisions;
  const double s = AdditiveRecurrence(effort.seed, kR2Alpha[0]),
               t = AdditiveRecurrence(effort.seed, kR2Alpha[1]);
  double all = 0, visible = 0;
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; j < divisions; ++j) {
      const Vec3 to = PointOn(luminaire.Vertices(), (i + s) / divisions, (j + t) / divisions);
      const double weight = Kernel(at, luminaire.normal, to);
      if (weight <= 0) continue;
      all += weight;
      if (!caster_.Blocked(from, to + lift_ * luminaire.normal)) visible += weight;
    }
  if (all <= 0) {
    // Only a part between the places is above the horizon.
    const Polygon3 above = ClipToHalfSpace(luminaire.Vertices(), at.normal, at.position);
    if (above.size() < 3) return {0, 0};
    Vec3 centre = Vec3::Zero();
    for (const Vec3& v : above) centre += v / static_cast<double>(above.size());
    all = Kernel(at, luminaire.normal, centre);
    visible = caster_.Blocked(from, centre + lift_ * luminaire.normal) ? 0 : all;
  }
  const double of_cell = luminaire.area / (std::numbers::pi * divisions * divisions);
  return {of_cell * all, of_cell * visible};
}

Rgb ShadowRays::Unhindered(const ReceiverPoint& at, const Luminaire& luminaire) const {
  if (luminaire.emits) {
    Gathering gathering(scene_, sources_, at, {}, nullptr);
    gathering.AddSource(luminaire.patch, {}, kNoPatch);
    return gathering.irradiance();
  }
  const Polygon3 above = ClipToHalfSpace(luminaire.Vertices(), at.normal, at.position);
  if (above.size() < 3) return Rgb::Zero();
  // The edge sum is positive for the order that is clockwise from the front.
  std::vector<Vec3> offsets;
  for (auto v = above.rbegin(); v != above.rend(); ++v) offsets.push_back(*v - at.position);
  return FormFactor(Vec3::Zero(), offsets, at.normal) * luminaire.radiosity;
}

Rgb ShadowRays::Exact(const ReceiverPoint& at, PatchId emitter) const {
  Gathering gathering(scene_, sources_, at, {}, nullptr);
  gathering.AddSource(emitter, patches_, {});
  return gathering.irradiance();
}

// Rays to points of the weak luminaires, as many to each as its estimated light deserves.
void ShadowRays::AddWeak(const Vec3& from, const ReceiverPoint& at, std::span<const Seen> weak,
                         const ShadowRayEffort& effort, Gathered& sum) const {
  double total = 0;
  for (const Seen& s : weak) total += s.light;
  if (total <= 0) return;
  const int each = effort.divisions * effort.divisions;
  const int rays =
      std::max({1, each, static_cast<int>(std::ceil(each * total / (kStrong * sum.unoccluded)))});
  const double shift = AdditiveRecurrence(effort.seed, kR2Alpha[0]);
  std::size_t i = 0;
  double before = 0;
  for (int k = 0; k < rays; ++k) {
    const double place = (k + shift) / rays * total;
    while (i + 1 < weak.size() && before + weak[i].light <= place) before += weak[i++].light;
    const Luminaire& luminaire = luminaires_[weak[i].luminaire];
    const auto number = static_cast<std::uint64_t>(k) + effort.seed * static_cast<std::uint64_t>(rays);
    const Vec3 to = PointOn(luminaire.Vertices(), AdditiveRecurrence(number, kR2Alpha[0]),
                            AdditiveRecurrence(number, kR2Alpha[1]));
    const double kernel = Kernel(at, luminaire.normal, to);
    if (kernel <= 0 || caster_.Blocked(from, to + lift_ * luminaire.normal)) continue;
    const double factor = kernel * luminaire.area / std::numbers::pi;
    const double chosen = rays * weak[i].light / total;  // the expected number of rays of this luminaire
    sum.Add(luminaire.patch, luminaire.emits, factor / chosen * luminaire.radiosity);
  }
}

Rgb ShadowRays::At(const ReceiverPoint& at, const ShadowRayEffort& effort, IrradianceParts* parts) const {
  const Scratch<std::vector<Seen>> scratch;
  std::vector<Seen>& seen = *scratch;
  FindSeen(at, seen);
  Gathered sum{.light = Rgb::Zero(), .unoccluded = 0, .parts = parts};
  for (const Seen& s : seen) sum.unoccluded += s.light;
  double rest = sum.unoccluded;
  const Vec3 from = RayStart(at, lift_);
  std::size_t i = 0;
  for (; effort.divisions > 0 && i < seen.size() && seen[i].light >= kStrong * sum.unoccluded; ++i) {
    rest -= seen[i].light;
    const Luminaire& luminaire = luminaires_[seen[i].luminaire];
    const RaySums rays = CastRays(from, at, luminaire, effort);
    if (rays.visible <= 0) continue;
    const bool is_far = (luminaire.centre - at.position).norm() > kFarFromReflector * luminaire.radius;
    if (!luminaire.emits && is_far) {
      sum.Add(luminaire.patch, false, rays.visible * luminaire.radiosity);
      continue;
    }
    const Rgb unhindered = Unhindered(at, luminaire);
    const bool exact = luminaire.emits && rays.visible < rays.all &&
                       unhindered.maxCoeff() > effort.exact_above * (sum.light.maxCoeff() + rest);
    sum.Add(luminaire.patch, luminaire.emits,
            exact ? Exact(at, luminaire.patch) : Rgb(rays.visible / rays.all * unhindered));
  }
  AddWeak(from, at, std::span(seen).subspan(i), effort, sum);
  return sum.light;
}

}  // namespace penumbra
