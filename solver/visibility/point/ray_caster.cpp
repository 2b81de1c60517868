#include "solver/visibility/point/ray_caster.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <optional>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// Two coincident faces with opposite fronts are one sheet: a ray hits the front. Hits whose distance is below
// this times the scene's diagonal coincide (floats have 7 digits).
constexpr double kSamePlace = 1e-6;

// Embree passes the intersection context to the filter, so the context carries the ray's own patch.
struct FilterContext {
  RTCIntersectContext base;
  unsigned int ignore = RTC_INVALID_GEOMETRY_ID;
  const std::vector<Vec3>* backs = nullptr;  // the patches' normals, if rays pass through backs
  Vec3 direction = Vec3::Zero();

  FilterContext() { rtcInitIntersectContext(&base); }
};

void FilterHits(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const FilterContext*>(args->context);
  for (unsigned int i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const unsigned int patch = RTCHitN_primID(args->hit, args->N, i);
    const bool back = context->backs && (*context->backs)[patch].dot(context->direction) >= 0;
    if (patch == context->ignore || back) args->valid[i] = 0;
  }
}

// Makes Embree call the filter for hits of rays with this context. Rays without a filter are faster.
void UseFilter(FilterContext& context) { context.base.filter = &FilterHits; }

// Throws if the condition `is_so` is false or Embree reports an error. Throws std::bad_alloc if memory is
// exhausted; Embree reports this as an unknown error if it happens in its tasks or threads. Embree's objects
// then remain until the program ends, because Embree aborts when half-built objects are destroyed.
void Demand(RTCDevice device, bool is_so) {
  const RTCError error = rtcGetDeviceError(device);
  if (is_so && error == RTC_ERROR_NONE) return;
  if (error == RTC_ERROR_UNSUPPORTED_CPU)
    throw InputError("penumbra: error: rays cannot be cast, since Embree does not know this processor");
  throw std::bad_alloc();
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Vec3> normals;   // unit, one for each patch
  double diagonal = 0;         // of the scene [m]
  Vec3 origin = Vec3::Zero();  // of Embree's coordinates, at the middle of the scene: floats have 7 digits

  RTCRayHit Intersect(const Vec3& from, const Vec3& direction, double near, double far,
                      FilterContext& context) const;
  // The first hit of a ray, or the coincident front of another patch (RayCaster::Cast()).
  Hit FrontOf(const Hit& first, const Vec3& from, const Vec3& direction, FilterContext context) const;
  // Sets `from` to the start of the ray from `origin`, in Embree's coordinates. Returns the distance skipped
  // before the start, in lengths of `direction`; nothing if the ray misses the scene.
  std::optional<double> Approach(const Vec3& origin, const Vec3& direction, Vec3* from) const;
};

RayCaster::RayCaster(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  Demand(nullptr, impl_->device != nullptr);
  impl_->scene = rtcNewScene(impl_->device);
  Demand(impl_->device, impl_->scene != nullptr);
  rtcSetSceneFlags(impl_->scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST |
                                                            RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
  const auto [low, high] = scene.Bounds();
  impl_->origin = 0.5 * (low + high);
  impl_->diagonal = (high - low).norm();
  if (!scene.patches.empty()) {
    // Embree represents a triangle as a quad whose last two vertices coincide.
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_QUAD);
    Demand(impl_->device, geometry != nullptr);
    const std::size_t count = scene.patches.size();
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * count));
    auto* index = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned int), count));
    Demand(impl_->device, vertex != nullptr && index != nullptr);
    for (std::size_t p = 0; p < count; ++p) {
      impl_->normals.push_back(scene.patches[p].normal);
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 v = scene.patches[p].vertex[k] - impl_->origin;
        for (int axis = 0; axis < 3; ++axis)
          vertex[3 * (4 * p + k) + static_cast<std::size_t>(axis)] = static_cast<float>(v[axis]);
        index[4 * p + k] = static_cast<unsigned int>(4 * p + k);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
  Demand(impl_->device, true);
}

RayCaster::~RayCaster() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

namespace {

RTCRay MakeRay(const Vec3& from, const Vec3& direction, double near, double far) {
  RTCRay ray{};
  ray.org_x = static_cast<float>(from.x());
  ray.org_y = static_cast<float>(from.y());
  ray.org_z = static_cast<float>(from.z());
  ray.dir_x = static_cast<float>(direction.x());
  ray.dir_y = static_cast<float>(direction.y());
  ray.dir_z = static_cast<float>(direction.z());
  ray.tnear = static_cast<float>(near);
  ray.tfar = static_cast<float>(far);
  ray.mask = 0xFFFFFFFFU;
  return ray;
}

// Makes a ray the i-th of a packet.
void Set(RTCRay8& packet, std::size_t i, const RTCRay& ray) {
  packet.org_x[i] = ray.org_x;
  packet.org_y[i] = ray.org_y;
  packet.org_z[i] = ray.org_z;
  packet.dir_x[i] = ray.dir_x;
  packet.dir_y[i] = ray.dir_y;
  packet.dir_z[i] = ray.dir_z;
  packet.tnear[i] = ray.tnear;
  packet.tfar[i] = ray.tfar;
  packet.mask[i] = ray.mask;
}

}  // namespace

RTCRayHit RayCaster::Impl::Intersect(const Vec3& from, const Vec3& direction, double near, double far,
                                     FilterContext& context) const {
  RTCRayHit ray{};
  ray.ray = MakeRay(from, direction, near, far);
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context.base, &ray);
  return ray;
}

RayCaster::Hit RayCaster::Impl::FrontOf(const Hit& first, const Vec3& from, const Vec3& direction,
                                        FilterContext context) const {
  if (normals[static_cast<std::size_t>(first.patch)].dot(direction) < 0)
    return {first.patch, first.distance, true};
  const double margin = kSamePlace * diagonal / direction.norm();
  context.backs = &normals;
  context.direction = direction;
  UseFilter(context);
  const RTCRayHit front =
      Intersect(from, direction, std::max(0.0, first.distance - margin), first.distance + margin, context);
  if (front.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {first.patch, first.distance, false};
  return {static_cast<PatchId>(front.hit.primID), static_cast<double>(front.ray.tfar), true};
}

std::optional<double> RayCaster::Impl::Approach(const Vec3& start, const Vec3& direction, Vec3* from) const {
  // A ray from far away starts near the sphere around the scene: floats would overflow or lose digits.
  *from = start - origin;
  if (from->squaredNorm() <= diagonal * diagonal) return 0;
  const double distance = from->stableNorm(), reach = diagonal;
  if (distance <= 2 * reach) return 0;
  const double along =
      -(*from / distance).dot(direction) / direction.norm() * distance;  // to the nearest point
  if (!(along > 0)) return std::nullopt;
  const double skipped = (along - reach) / direction.norm();
  *from += skipped * direction;
  if (!(from->stableNorm() <= 2 * reach)) return std::nullopt;
  return skipped;
}

RayCaster::Hit RayCaster::Cast(const Vec3& origin, const Vec3& direction, PatchId ignore) const {
  FilterContext context;
  if (ignore != kNoPatch) {
    context.ignore = static_cast<unsigned int>(ignore);
    UseFilter(context);
  }
  Vec3 from;
  const std::optional<double> approach = impl_->Approach(origin, direction, &from);
  if (!approach) return {};
  const double skipped = *approach;

  const double infinity = std::numeric_limits<double>::infinity();
  const RTCRayHit first = impl_->Intersect(from, direction, 0, infinity, context);
  if (first.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  Hit hit = impl_->FrontOf({static_cast<PatchId>(first.hit.primID), static_cast<double>(first.ray.tfar)},
                           from, direction, context);
  hit.distance += skipped;
  return hit;
}

void RayCaster::CastTogether(std::span<const Vec3> origins, const Vec3& direction,
                             std::span<Hit> hits) const {
  PENUMBRA_CHECK(origins.size() <= kPacket && hits.size() == origins.size());
  alignas(32) RTCRayHit8 packet{};
  alignas(32) std::array<int, kPacket> valid{};
  std::array<double, kPacket> skipped{};
  for (std::size_t i = 0; i < origins.size(); ++i) {
    Vec3 from;
    const std::optional<double> approach = impl_->Approach(origins[i], direction, &from);
    if (!approach) continue;
    skipped[i] = *approach;
    valid[i] = -1;
    Set(packet.ray, i, MakeRay(from, direction, 0, std::numeric_limits<double>::infinity()));
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  FilterContext context;
  context.base.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid.data(), impl_->scene, &context.base, &packet);
  for (std::size_t i = 0; i < origins.size(); ++i) {
    hits[i] = {};
    if (valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    const Hit first{static_cast<PatchId>(packet.hit.primID[i]), static_cast<double>(packet.ray.tfar[i])};
    hits[i] = impl_->FrontOf(first, origins[i] - impl_->origin + skipped[i] * direction, direction, {});
    hits[i].distance += skipped[i];
  }
}

std::uint32_t RayCaster::BlockedTogether(std::span<const Vec3> from, std::span<const Vec3> to) const {
  PENUMBRA_CHECK(from.size() <= kPacket && to.size() == from.size());
  alignas(32) RTCRay8 packet{};
  alignas(32) std::array<int, kPacket> valid{};
  for (std::size_t i = 0; i < from.size(); ++i) {
    valid[i] = -1;
    Set(packet, i, MakeRay(from[i] - impl_->origin, to[i] - from[i], 0, 1));
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(valid.data(), impl_->scene, &context, &packet);
  std::uint32_t blocked = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    if (packet.tfar[i] < 0) blocked |= std::uint32_t{1} << i;
  return blocked;
}

bool RayCaster::Blocked(const Vec3& from, const Vec3& to) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = MakeRay(from - impl_->origin, to - from, 0, 1);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0;
}

RayCaster::Hit RayCaster::CastToFront(const Vec3& origin, const Vec3& direction) const {
  FilterContext context;
  context.backs = &impl_->normals;
  context.direction = direction;
  UseFilter(context);
  Vec3 from;
  const std::optional<double> skipped = impl_->Approach(origin, direction, &from);
  if (!skipped) return {};
  const RTCRayHit hit =
      impl_->Intersect(from, direction, 0, std::numeric_limits<double>::infinity(), context);
  if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {static_cast<PatchId>(hit.hit.primID), *skipped + static_cast<double>(hit.ray.tfar), true};
}

}  // namespace penumbra
