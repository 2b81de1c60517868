#include "solver/transport/points/free_area.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/scene/tolerances.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/leaf_fragments.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/point/ray_caster.h"

namespace penumbra {
namespace {

// A part is free if fronts fill more than this fraction of its hemisphere. Gaps of ContactGap(), 1e-6 of the
// scene, let in less light, under objects as small as a hundredth of the scene.
constexpr double kThroughGaps = 1e-4;

// Rays that look for the sky above a part that sees no front.
constexpr int kSkyRays = 32;

// Whether a ray from the part leaves the scene. The origin lies behind the part, so that what lies flat on
// the part is in the way.
bool SeesSky(const RayCaster& rays, PatchId patch, const Vec3& normal, const Vec3& origin) {
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  for (int i = 0; i < kSkyRays; ++i) {
    const double sine = std::sqrt(AdditiveRecurrence(static_cast<std::uint64_t>(i), kR2Alpha[0]));
    const double around =
        2 * std::numbers::pi * AdditiveRecurrence(static_cast<std::uint64_t>(i), kR2Alpha[1]);
    const Vec3 direction = sine * (std::cos(around) * frame.u + std::sin(around) * frame.v) +
                           std::sqrt(1 - sine * sine) * normal;
    if (rays.Cast(origin, direction, patch).patch == kNoPatch) return true;
  }
  return false;
}

// The area that a convex part of a patch shares with a part of a face [m^2].
double CommonArea(Polygon3 part, const AreaPart& of_face, const Scene& scene) {
  const Vec3& normal = scene.patches[static_cast<std::size_t>(of_face.patch)].normal;
  const Polygon3& other = of_face.polygon;
  for (std::size_t i = 0; i < other.size() && !part.empty(); ++i) {
    const Vec3 inwards = normal.cross(other[(i + 1) % other.size()] - other[i]);
    if (!inwards.isZero(0)) part = ClipToHalfSpace(part, inwards.normalized(), other[i]);
  }
  return VectorArea(part).norm();
}

}  // namespace

std::vector<std::vector<ContactPart>> ContactParts(const Scene& scene, const ExecutionContext& context) {
  // All fronts have unit radiosity, so irradiance is the fraction of the hemisphere that fronts fill.
  Scene bright = scene;
  for (Material& material : bright.materials) material.emittance = Rgb::Ones();
  const PatchVisibility unused;
  const PointIrradiance seen(bright, unused, SourceSet::Emitters(bright));
  const RayCaster rays(scene);
  const double gap = ContactGap(scene);
  const std::vector<Fragment> fragments = CutLeavesAtContacts(ElementForest(scene), context);
  std::vector<std::vector<ContactPart>> parts(scene.patches.size());
  ParallelFor(parts.size(), 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    const auto id = static_cast<PatchId>(p);
    const Patch& patch = scene.patches[p];
    const auto add = [&](std::span<const Vec3> polygon, double area) {
      ContactPart part{{polygon.begin(), polygon.end()}, area};
      ReceiverPoint at;
      at.position = Centroid(polygon);
      at.normal = patch.normal;
      part.sees_fronts = seen.Anywhere(at).irradiance[0] > kThroughGaps;
      part.sees_sky = !part.sees_fronts && SeesSky(rays, id, patch.normal, at.position - gap * patch.normal);
      parts[p].push_back(std::move(part));
    };
    const std::span<const Fragment> own = FragmentsOf(fragments, ElementForest::Root(id));
    if (own.empty()) add(patch.Vertices(), patch.area);
    for (const Fragment& part : own) add(part.polygon, part.area);
  });
  return parts;
}

std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context) {
  std::vector<double> area;
  for (const std::vector<ContactPart>& parts : ContactParts(scene, context)) {
    double sum = 0;
    for (const ContactPart& part : parts)
      if (part.sees_fronts) sum += part.area;
    area.push_back(sum);
  }
  return area;
}

std::vector<double> UncoveredAreas(const Scene& scene, const std::vector<std::vector<ContactPart>>& parts,
                                   const std::vector<std::vector<AreaPart>>& groups) {
  std::vector<double> areas;
  for (const std::vector<AreaPart>& group : groups) {
    double sum = 0;
    for (const AreaPart& of_face : group) {
      const auto p = static_cast<std::size_t>(of_face.patch);
      for (const ContactPart& part : parts[p])
        if (part.sees_fronts || part.sees_sky)
          sum += scene.patches[p].faces.size() == 1 ? part.area : CommonArea(part.polygon, of_face, scene);
    }
    areas.push_back(sum);
  }
  return areas;
}

}  // namespace penumbra
