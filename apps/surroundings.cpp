#include "apps/surroundings.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "solver/geometry/polygon.h"
#include "solver/geometry/polygon_distance.h"
#include "solver/scene/text_reader.h"
#include "solver/visibility/point/enclosure.h"

namespace penumbra {
namespace {

constexpr double kOneDegree = std::numbers::pi / 180;

// The lowest of the faces that the patch covers within `reach` of the point.
std::int32_t LowestFace(const Scene& scene, PatchId id, const Vec3& position, double reach) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
  if (patch.faces.size() > 1)
    for (const std::int32_t face : patch.faces)
      if (ConvexContains(scene.faces[static_cast<std::size_t>(face)].vertices, patch.normal, position, reach))
        return face;
  return scene.FaceAt(id, position);
}

// The largest distance of a corner from the plane of a patch [m].
double Unevenness(const Patch& patch) {
  double largest = 0;
  for (const Vec3& v : patch.Vertices())
    largest = std::max(largest, std::abs(patch.normal.dot(v - patch.vertex[0])));
  return largest;
}

}  // namespace

double PatchReach(const Scene& scene) { return kOnPatchDistance * scene.Diagonal(); }

PointFace FindFace(const Scene& scene, const Vec3& position, const std::optional<Vec3>& normal) {
  PointFace lowest;
  const double least_cosine = std::cos(kOnPatchDegrees * kOneDegree), reach = PatchReach(scene);
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    const Patch& patch = scene.patches[i];
    if (normal && patch.normal.dot(*normal) < least_cosine) continue;
    if (std::abs(patch.normal.dot(position - patch.vertex[0])) > reach) continue;
    if (!ConvexContains(patch.Vertices(), patch.normal, position, reach)) continue;
    const auto id = static_cast<PatchId>(i);
    const std::int32_t face = LowestFace(scene, id, position, reach);
    if (lowest.patch == kNoPatch || face < lowest.face) lowest = {face, id};
  }
  return lowest;
}

void TakeNormalsOfFaces(const Scene& scene, const std::string& name, std::vector<ProbePoint>* points) {
  for (ProbePoint& point : *points) {
    if (point.has_normal) continue;
    const PointFace at = FindFace(scene, point.position, std::nullopt);
    if (at.patch == kNoPatch)
      throw ErrorAt(name, point.line,
                    "the point has no normal and lies on no face, whose normal it could have; give nx,ny,nz");
    point.normal = scene.patches[static_cast<std::size_t>(at.patch)].normal;
    point.has_normal = true;
  }
}

Surroundings::Surroundings(const Scene& scene) : scene_(scene), rays_(scene), reach_(PatchReach(scene)) {
  std::tie(low_, high_) = scene.Bounds();
}

bool Surroundings::IsFar(const Vec3& position) const {
  const Vec3 nearest = position.cwiseMax(low_).cwiseMin(high_);
  return !scene_.patches.empty() &&
         (position - nearest).stableNorm() > kFarDiagonals * (high_ - low_).stableNorm();
}

Vec3 Surroundings::BeforeBacks(PatchId id, const Vec3& foot) const {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const double least_cosine = std::cos(kOnPatchDegrees * kOneDegree);
  const Patch& own = scene_.patches[static_cast<std::size_t>(id)];
  const double rounding = kRounding * std::max(MaxAbs(low_), MaxAbs(high_));
  double ahead = rounding;  // a plane that contains the foot, to rounding, is not in the way
  for (const Patch& other : scene_.patches) {
    if (-other.normal.dot(own.normal) < least_cosine) continue;
    const double behind = other.normal.dot(foot - other.vertex[0]);
    if (behind <= ahead || behind > Unevenness(own) + Unevenness(other)) continue;
    if (ConvexContains(other.Vertices(), other.normal, foot, reach_)) ahead = behind;
  }
  return ahead > rounding ? Vec3(foot + ahead * own.normal) : foot;
}

bool Surroundings::SeesOnlyBacks(const Vec3& position, const Vec3& normal) const {
  // A point on a surface stands on the side that its normal points to, in the floats of rays, too, which
  // count from the middle of the scene; where the scene lies plays no part.
  constexpr double kFloatRounding = 8 * std::numeric_limits<float>::epsilon();
  const double from_middle = MaxAbs(position - 0.5 * (low_ + high_));
  const Vec3 eye = position + (reach_ + kFloatRounding * from_middle) * normal;
  // Furniture without a bottom stands on an uncut floor: a look down from inside it meets a front.
  for (const Vec3& up : {normal, Vec3(-normal)}) {
    bool any_back = false, any_front = false;
    for (const Vec3& direction : LookAround(up)) {
      const RayCaster::Hit hit = rays_.Cast(eye, direction);
      if (hit.patch != kNoPatch) (hit.front ? any_front : any_back) = true;
    }
    if (any_front) return false;
    if (any_back) return true;
  }
  return false;
}

}  // namespace penumbra
