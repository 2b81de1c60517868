#include "solver/transport/points/shadow_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/base/check.h"
#include "solver/base/random.h"
#include "solver/base/scratch.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/surface_points.h"
#include "solver/transport/points/mean_free_path.h"
#include "solver/transport/points/ray_ends.h"
#include "solver/visibility/point/form_factor.h"

namespace penumbra {
namespace {

// A luminaire is strong if its unoccluded light is at least this times that of all.
constexpr double kStrong = 0.05;
// Farther than this times its radius, the sum over rays tells the light of a reflector to a per cent.
constexpr double kFarFromReflector = 4;
// A luminaire that a region seems not to see counts as much as one with this times its light: rays that find
// a part of it after all must not weigh so much that they show as noise.
constexpr double kIfHidden = 1.0 / 4;
// A half-hidden emitter whose light is all that a point gets, is given this times the rays of one whose light
// is little beside that of others: its error is then the error of the whole.
constexpr double kRaysIfAlone = 4;
// A region does not look for a luminaire that sends none of its points this times the light of all.
constexpr double kNotLookedFor = 1e-3;
// Fewer rays that all miss a luminaire do not tell that it is hidden: a luminaire of which a region sees a
// fifth is missed by 12 rays in 7 of 100 cases.
constexpr std::size_t kLeastLooks = 12;
// A luminaire within this times the scene's mean free path of a region never counts as hidden: a part of a
// near luminaire that no ray has found may be most of a point's light, and a rare hit on it would show as a
// spot.
constexpr double kNearOfFreePath = 2;
// With fewer luminaires, looking for them does not pay.
constexpr std::size_t kFewLuminaires = 16;
// A luminaire a b c d is a parallelogram if |a - b + c - d| is less than this times its radius.
constexpr double kMostSkew = 1e-6;

std::vector<PatchId> EveryPatch(const Scene& scene) {
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// The light that a small piece of surface at `to` sends, without blockers and constant factors.
double Kernel(const ReceiverPoint& at, const Vec3& normal, const Vec3& to) {
  const Vec3 d = to - at.position;
  const double r2 = d.squaredNorm(), cosines = at.normal.dot(d) * -normal.dot(d);
  return at.normal.dot(d) > 0 && cosines > 0 ? cosines / (r2 * r2) : 0;
}

}  // namespace

// Neighbouring points, and the light that has been found for them so far.
struct ShadowRays::Group {
  std::span<const ReceiverPoint> at;
  std::array<Vec3, kTogether> from;  // where rays start
  Values unoccluded{};               // of all luminaires, estimated in the brightest channel [W/m^2]
  std::span<Rgb> light;
  IrradianceParts* parts = nullptr;  // of the first point

  std::size_t size() const { return at.size(); }

  void Add(std::size_t point, const Luminaire& luminaire, const Rgb& irradiance) {
    light[point] += irradiance;
    if (!parts || point != 0 || !(irradiance > 0).any()) return;
    parts->contributions.push_back({luminaire.patch, irradiance});
    if (luminaire.emits) parts->direct += irradiance;
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

Vec3 ShadowRays::Luminaire::Place(double s, double t) const {
  if (!is_parallelogram) return PointOn(Vertices(), s, t);
  return vertex[0] + s * (vertex[1] - vertex[0]) + t * (vertex[3] - vertex[0]);
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
  added.is_parallelogram = polygon.size() == 4 && (polygon[0] - polygon[1] + polygon[2] - polygon[3]).norm() <
                                                      kMostSkew * added.radius;
  luminaires_.push_back(added);
}

// The points of a group that the luminaire may light, one bit for each.
std::uint32_t ShadowRays::PointsLitBy(const Seen& seen) {
  std::uint32_t points = 0;
  for (std::size_t p = 0; p < seen.light.size(); ++p)
    if (seen.light[p] > 0) points |= std::uint32_t{1} << p;
  return points;
}

// An estimate of the unoccluded light of a luminaire at a point, in the brightest channel [W/m^2]. Zero if
// the luminaire does not lie before the point, or the point not before the luminaire.
double ShadowRays::Estimate(const ReceiverPoint& at, const Luminaire& luminaire) const {
  const Vec3 to = luminaire.centre - at.position;
  const double high = at.normal.dot(to) + luminaire.radius, deep = -luminaire.normal.dot(to);
  // What lies in the plane of a reflector gets none of its light.
  if (high <= 0 || deep < (luminaire.emits ? -lift_ : lift_)) return 0;
  const double distance = std::max(to.norm(), luminaire.radius);
  // Near a large luminaire, parts of it are seen much less obliquely than its centre.
  const double bulge = luminaire.radius * luminaire.radius / distance;
  const double cosines = std::min(1.0, high / distance) * std::min(1.0, (deep + bulge) / distance);
  return luminaire.brightness *
         std::min(1.0, luminaire.area * cosines / (std::numbers::pi * distance * distance));
}

void ShadowRays::Learn(std::span<const ReceiverPoint> points, double side) {
  if (luminaires_.size() < kFewLuminaires || !(side > 0)) return;
  near_ = kNearOfFreePath * MeanFreePath(scene_);
  hidden_ = HiddenLuminaires(points, side, luminaires_.size(),
                             [this](std::span<const ReceiverPoint> of_region,
                                    std::span<std::uint64_t> hidden) { FindHidden(of_region, hidden); });
}

bool ShadowRays::IsNear(const ReceiverPoint& at, const Luminaire& luminaire) const {
  return (luminaire.centre - at.position).norm() - luminaire.radius < near_;
}

// Whether a ray from the point reaches a place of the luminaire, another place for each number of the ray.
bool ShadowRays::Sees(const ReceiverPoint& at, const Luminaire& luminaire, std::size_t ray) const {
  const Vec3 to = luminaire.Place(AdditiveRecurrence(ray, kR2Alpha[0]), AdditiveRecurrence(ray, kR2Alpha[1]));
  return Kernel(at, luminaire.normal, to) > 0 &&
         !caster_.Blocked(RayStart(at, lift_), to + lift_ * luminaire.normal);
}

// Sets the bits of the luminaires that matter, but that no ray of the points reaches.
void ShadowRays::FindHidden(std::span<const ReceiverPoint> points, std::span<std::uint64_t> hidden) const {
  std::vector<double> all(points.size(), 0.0), light(points.size());
  for (const Luminaire& luminaire : luminaires_)
    for (std::size_t k = 0; k < points.size(); ++k) all[k] += Estimate(points[k], luminaire);
  for (std::size_t i = 0; i < luminaires_.size(); ++i) {
    bool matters = false, is_seen = false;
    std::size_t looks = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      light[k] = Estimate(points[k], luminaires_[i]);
      if (light[k] > 0) ++looks;
      matters = matters || (light[k] > 0 && light[k] >= kNotLookedFor * all[k]);
    }
    if (!matters || looks < kLeastLooks) continue;
    for (std::size_t k = 0; k < points.size() && !is_seen; ++k)
      is_seen = light[k] > 0 && (IsNear(points[k], luminaires_[i]) || Sees(points[k], luminaires_[i], k));
    if (!is_seen) hidden[i / 64] |= std::uint64_t{1} << (i % 64);
  }
}

// Lists the luminaires that may light a point of the group, in descending order of light.
void ShadowRays::FindSeen(Group& group, bool trusts_region, std::vector<Seen>& seen) const {
  std::array<HiddenLuminaires::Bits, kTogether> hidden;
  for (std::size_t p = 0; p < group.size(); ++p)
    if (trusts_region) hidden[p] = hidden_.At(group.at[p]);
  const auto is_hidden = [&](std::size_t luminaire) {
    for (std::size_t p = 0; p < group.size(); ++p)
      if (!HiddenLuminaires::Has(hidden[p], luminaire)) return false;
    return true;
  };
  for (std::size_t i = 0; i < luminaires_.size(); ++i) {
    Seen luminaire{.light = {}, .total = 0, .luminaire = i};
    const double part = is_hidden(i) ? kIfHidden : 1;
    for (std::size_t p = 0; p < group.size(); ++p) {
      luminaire.light[p] = part * Estimate(group.at[p], luminaires_[i]);
      luminaire.total += luminaire.light[p];
      group.unoccluded[p] += luminaire.light[p];
    }
    if (luminaire.total > 0) seen.push_back(luminaire);
  }
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.total > b.total; });
}

// Adds the Kernel() of a place of the luminaire to the sums of the points in `which`.
void ShadowRays::AddPlace(const Group& group, std::uint32_t which, const Luminaire& luminaire, const Vec3& to,
                          RaySums& sums) const {
  std::array<std::size_t, kTogether> point;
  std::array<Vec3, kTogether> from, end;
  std::array<double, kTogether> weight;
  std::size_t count = 0;
  for (std::size_t p = 0; p < group.size(); ++p) {
    if ((which >> p & 1) == 0) continue;
    weight[count] = Kernel(group.at[p], luminaire.normal, to);
    if (weight[count] <= 0) continue;
    point[count] = p;
    from[count] = group.from[p];
    end[count] = to + lift_ * luminaire.normal;
    ++count;
  }
  if (count == 0) return;
  const std::uint32_t blocked =
      count == 1 ? (caster_.Blocked(from[0], end[0]) ? 1 : 0)
                 : caster_.BlockedTogether(std::span(from).first(count), std::span(end).first(count));
  for (std::size_t k = 0; k < count; ++k) {
    sums.all[point[k]] += weight[k];
    if ((blocked >> k & 1) == 0) sums.visible[point[k]] += weight[k];
  }
}

// Follows rays to the same place in each of divisions^2 cells of the luminaire.
ShadowRays::RaySums ShadowRays::CastRays(const Group& group, std::uint32_t which, const Luminaire& luminaire,
                                         const ShadowRayEffort& effort) const {
  const int divisions = effort.divisions;
  const double s = AdditiveRecurrence(effort.seed, kR2Alpha[0]),
               t = AdditiveRecurrence(effort.seed, kR2Alpha[1]);
  RaySums sums;
  for (int i = 0; i < divisions; ++i)
    for (int j = 0; j < divisions; ++j)
      AddPlace(group, which, luminaire, luminaire.Place((i + s) / divisions, (j + t) / divisions), sums);
  const double of_cell = luminaire.area / (std::numbers::pi * divisions * divisions);
  for (std::size_t p = 0; p < group.size(); ++p) {
    if ((which >> p & 1) != 0 && sums.all[p] <= 0) {
      // Only a part between the places is above the horizon.
      const ReceiverPoint& at = group.at[p];
      const Polygon3 above = ClipToHalfSpace(luminaire.Vertices(), at.normal, at.position);
      if (above.size() < 3) continue;
      AddPlace(group, std::uint32_t{1} << p, luminaire, Centroid(above), sums);
    }
    sums.all[p] *= of_cell;
    sums.visible[p] *= of_cell;
  }
  return sums;
}

// Follows rays to evenly distributed places: along each line across the luminaire, a thin blocker hides about
// the right number of them, unlike places in rows and columns.
ShadowRays::RaySums ShadowRays::CastMoreRays(const Group& group, std::uint32_t which,
                                             const Luminaire& luminaire,
                                             const ShadowRayEffort& effort) const {
  RaySums sums;
  const auto rays = static_cast<std::uint64_t>(effort.rays_if_hidden);
  for (std::uint64_t k = effort.seed * rays; k < (effort.seed + 1) * rays; ++k)
    AddPlace(group, which, luminaire,
             luminaire.Place(AdditiveRecurrence(k, kR2Alpha[0]), AdditiveRecurrence(k, kR2Alpha[1])), sums);
  return sums;
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
  // As for rays: the digits of a file leave a face planar to rounding only, so that a point on a face may lie
  // behind parts of the face.
  ReceiverPoint lifted = at;
  lifted.position = RayStart(at, lift_);
  Gathering gathering(scene_, sources_, lifted, {}, nullptr);
  gathering.AddSource(emitter, patches_, {});
  return gathering.irradiance();
}

// Adds the light of a strong luminaire. `rest` is the estimated light of the luminaires after it.
void ShadowRays::AddStrong(const Seen& strong, const Values& rest, const ShadowRayEffort& effort,
                           Group& group) const {
  const Luminaire& luminaire = luminaires_[strong.luminaire];
  const RaySums rays = CastRays(group, PointsLitBy(strong), luminaire, effort);
  std::uint32_t hidden = 0;
  double largest_share = 0;  // of the light of all, where the luminaire is half hidden
  std::array<Rgb, kTogether> unhindered;
  for (std::size_t p = 0; p < group.size(); ++p) {
    if (rays.visible[p] <= 0) continue;
    const ReceiverPoint& at = group.at[p];
    const bool is_far = (luminaire.centre - at.position).norm() > kFarFromReflector * luminaire.radius;
    if (!luminaire.emits && is_far) {
      group.Add(p, luminaire, rays.visible[p] * luminaire.radiosity);
      continue;
    }
    unhindered[p] = Unhindered(at, luminaire);
    const double own = unhindered[p].maxCoeff(), others = group.light[p].maxCoeff() + rest[p];
    if (luminaire.emits && rays.visible[p] < rays.all[p] && own > effort.closer_above * others) {
      hidden |= std::uint32_t{1} << p;
      largest_share = std::max(largest_share, own / (own + others));
    } else {
      group.Add(p, luminaire, rays.visible[p] / rays.all[p] * unhindered[p]);
    }
  }
  if (hidden == 0) return;
  RaySums more;
  if (effort.rays_if_hidden > 0) {
    ShadowRayEffort closer = effort;
    closer.rays_if_hidden =
        static_cast<int>(std::lround(effort.rays_if_hidden * (1 + (kRaysIfAlone - 1) * largest_share)));
    more = CastMoreRays(group, hidden, luminaire, closer);
  }
  for (std::size_t p = 0; p < group.size(); ++p) {
    if ((hidden >> p & 1) == 0) continue;
    if (effort.rays_if_hidden == 0)
      group.Add(p, luminaire, Exact(group.at[p], luminaire.patch));
    else if (more.visible[p] > 0)
      group.Add(p, luminaire, more.visible[p] / more.all[p] * unhindered[p]);
  }
}

// Rays to points of the weak luminaires, as many to each as its estimated light deserves. All points of the
// group use the same places, so that their rays can be traced together.
void ShadowRays::AddWeak(std::span<const Seen> weak, const ShadowRayEffort& effort, Group& group) const {
  Values total{};
  for (const Seen& s : weak)
    for (std::size_t p = 0; p < group.size(); ++p) total[p] += s.light[p];
  const int each = effort.divisions * effort.divisions;
  int rays = std::max(1, each);
  for (std::size_t p = 0; p < group.size(); ++p)
    if (total[p] > 0)
      rays = std::max(rays, static_cast<int>(std::ceil(each * total[p] / (kStrong * group.unoccluded[p]))));
  // The sum over the points of the relative light of each luminaire, up to and including it.
  const Scratch<std::vector<double>> scratch;
  std::vector<double>& up_to = *scratch;
  double sum = 0;
  for (const Seen& s : weak) {
    for (std::size_t p = 0; p < group.size(); ++p)
      if (s.light[p] > 0) sum += s.light[p] / group.unoccluded[p];
    up_to.push_back(sum);
  }
  if (sum <= 0) return;
  const double shift = AdditiveRecurrence(effort.seed, kR2Alpha[0]);
  std::size_t i = 0;
  for (int k = 0; k < rays; ++k) {
    while (i + 1 < weak.size() && up_to[i] <= (k + shift) / rays * sum) ++i;
    const Luminaire& luminaire = luminaires_[weak[i].luminaire];
    const auto number = static_cast<std::uint64_t>(k) + effort.seed * static_cast<std::uint64_t>(rays);
    RaySums seen;
    AddPlace(
        group, PointsLitBy(weak[i]), luminaire,
        luminaire.Place(AdditiveRecurrence(number, kR2Alpha[0]), AdditiveRecurrence(number, kR2Alpha[1])),
        seen);
    // The expected number of rays of this luminaire.
    const double chosen = rays * (up_to[i] - (i > 0 ? up_to[i - 1] : 0)) / sum;
    const double factor = luminaire.area / std::numbers::pi / chosen;
    for (std::size_t p = 0; p < group.size(); ++p)
      if (seen.visible[p] > 0) group.Add(p, luminaire, factor * seen.visible[p] * luminaire.radiosity);
  }
}

void ShadowRays::AtAll(std::span<const ReceiverPoint> points, const ShadowRayEffort& effort,
                       std::span<Rgb> irradiance, IrradianceParts* parts) const {
  PENUMBRA_CHECK(points.size() <= kTogether && irradiance.size() == points.size());
  Group group{.at = points, .from = {}, .unoccluded = {}, .light = irradiance, .parts = parts};
  for (std::size_t p = 0; p < points.size(); ++p) {
    group.from[p] = RayStart(points[p], lift_);
    irradiance[p] = Rgb::Zero();
  }
  const Scratch<std::vector<Seen>> scratch;
  std::vector<Seen>& seen = *scratch;
  // Exact visibility is asked for where each point counts: a hit on a luminaire that its region does not see
  // would stand for many rays.
  const bool is_exact = effort.rays_if_hidden == 0 && std::isfinite(effort.closer_above);
  FindSeen(group, !is_exact, seen);
  Values rest = group.unoccluded;
  const auto is_strong = [&](const Seen& s) {
    for (std::size_t p = 0; p < points.size(); ++p)
      if (s.light[p] > 0 && s.light[p] >= kStrong * group.unoccluded[p]) return true;
    return false;
  };
  const auto weak =
      effort.divisions > 0 ? std::stable_partition(seen.begin(), seen.end(), is_strong) : seen.begin();
  for (auto strong = seen.begin(); strong != weak; ++strong) {
    for (std::size_t p = 0; p < points.size(); ++p) rest[p] -= strong->light[p];
    AddStrong(*strong, rest, effort, group);
  }
  AddWeak(std::span(weak, seen.end()), effort, group);
}

Rgb ShadowRays::At(const ReceiverPoint& at, const ShadowRayEffort& effort, IrradianceParts* parts) const {
  Rgb irradiance;
  AtAll({&at, 1}, effort, {&irradiance, 1}, parts);
  return irradiance;
}

}  // namespace penumbra
