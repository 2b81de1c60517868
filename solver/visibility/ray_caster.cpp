#include "solver/visibility/ray_caster.h"

#include <embree3/rtcore.h>

#include <limits>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The ray's own patch travels with the intersection context, since Embree hands that to the filter.
struct FilterContext {
  RTCIntersectContext base;
  unsigned int ignore;
};

void IgnoreOwnPatch(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const FilterContext*>(args->context);
  for (unsigned int i = 0; i < args->N; ++i)
    if (args->valid[i] == -1 && RTCHitN_primID(args->hit, args->N, i) == context->ignore) args->valid[i] = 0;
}

}  // namespace

struct RayCaster::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Vec3> normals;   // unit, a patch
  Vec3 origin = Vec3::Zero();  // Embree's: the middle of the scene, since its floats keep 7 digits only
};

RayCaster::RayCaster(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  impl_->device = rtcNewDevice(nullptr);
  PENUMBRA_CHECK(impl_->device != nullptr);
  impl_->scene = rtcNewScene(impl_->device);
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  const auto [low, high] = scene.Bounds();
  impl_->origin = 0.5 * (low + high);
  if (!scene.patches.empty()) {
    // Triangles are quads whose last two vertices coincide, as Embree documents.
    const RTCGeometry geometry = rtcNewGeometry(impl_->device, RTC_GEOMETRY_TYPE_QUAD);
    const std::size_t count = scene.patches.size();
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * count));
    auto* index = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned int), count));
    for (std::size_t p = 0; p < count; ++p) {
      impl_->normals.push_back(scene.patches[p].normal);
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 v = scene.patches[p].vertex[k] - impl_->origin;
        for (int axis = 0; axis < 3; ++axis)
          vertex[3 * (4 * p + k) + static_cast<std::size_t>(axis)] = static_cast<float>(v[axis]);
        index[4 * p + k] = static_cast<unsigned int>(4 * p + k);
      }
    }
    rtcSetGeometryIntersectFilterFunction(geometry, &IgnoreOwnPatch);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(impl_->scene, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(impl_->scene);
}

RayCaster::~RayCaster() {
  rtcReleaseScene(impl_->scene);
  rtcReleaseDevice(impl_->device);
}

RayCaster::Hit RayCaster::Cast(const Vec3& origin, const Vec3& direction, PatchId ignore) const {
  FilterContext context;
  rtcInitIntersectContext(&context.base);
  context.ignore = ignore == kNoPatch ? RTC_INVALID_GEOMETRY_ID : static_cast<unsigned int>(ignore);
  const Vec3 from = origin - impl_->origin;
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(from.x());
  ray.ray.org_y = static_cast<float>(from.y());
  ray.ray.org_z = static_cast<float>(from.z());
  ray.ray.dir_x = static_cast<float>(direction.x());
  ray.ray.dir_y = static_cast<float>(direction.y());
  ray.ray.dir_z = static_cast<float>(direction.z());
  ray.ray.tfar = std::numeric_limits<float>::infinity();
  ray.ray.mask = 0xFFFFFFFFU;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context.base, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const auto patch = static_cast<PatchId>(ray.hit.primID);
  return {patch, static_cast<double>(ray.ray.tfar), impl_->normals[ray.hit.primID].dot(direction) < 0};
}

}  // namespace penumbra
