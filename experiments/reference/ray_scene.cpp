#include "experiments/reference/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// Planes nearer than this, relative to the scene's diagonal, are one: floats cannot tell them apart.
constexpr double kSamePlane = 1e-7;

// Travels with each ray to the filter.
struct PlaneContext {
  RTCIntersectContext base;
  const PlaneId* plane;  // of each patch
  PlaneId from, to;      // do not count
};

void PassOwnPlanes(const RTCFilterFunctionNArguments* args) {
  const auto* context = reinterpret_cast<const PlaneContext*>(args->context);
  for (unsigned int i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const PlaneId plane = context->plane[RTCHitN_primID(args->hit, args->N, i)];
    if (plane == context->from || plane == context->to) args->valid[i] = 0;
  }
}

}  // namespace

struct RayScene::Impl {
  const Scene* scene = nullptr;
  RTCDevice device = nullptr;
  RTCScene embree = nullptr;
  Vec3 origin = Vec3::Zero();  // Embree's: the middle of the scene, where floats are finest
  double diagonal = 0, half_extent = 0;
  std::vector<PlaneId> plane;
  std::vector<std::vector<PatchId>>
      reverse;  // patches on the same plane that look the other way and may overlap

  bool SamePlane(const Patch& a, const Patch& b) const {
    if (a.normal.cross(b.normal).norm() * diagonal > kSamePlane * diagonal) return false;
    return std::all_of(b.Vertices().begin(), b.Vertices().end(), [&](const Vec3& v) {
      return std::abs(a.normal.dot(v - a.vertex[0])) <= kSamePlane * diagonal;
    });
  }
  void FindPlanes();
  void Commit();
  PlaneContext Context(PlaneId from, PlaneId to) const {
    PlaneContext context;
    rtcInitIntersectContext(&context.base);
    context.plane = plane.data();
    context.from = from;
    context.to = to;
    return context;
  }
  RTCRay Ray(const Vec3& from, const Vec3& direction, float far) const {
    const Vec3 start = from - origin;
    RTCRay ray{};
    ray.org_x = static_cast<float>(start.x());
    ray.org_y = static_cast<float>(start.y());
    ray.org_z = static_cast<float>(start.z());
    ray.dir_x = static_cast<float>(direction.x());
    ray.dir_y = static_cast<float>(direction.y());
    ray.dir_z = static_cast<float>(direction.z());
    ray.tfar = far;
    ray.mask = 0xFFFFFFFFU;
    return ray;
  }
};

void RayScene::Impl::FindPlanes() {
  const std::vector<Patch>& patches = scene->patches;
  plane.assign(patches.size(), kNoPlane);
  reverse.resize(patches.size());
  std::vector<PatchId> first;  // of each plane
  for (std::size_t p = 0; p < patches.size(); ++p) {
    for (std::size_t k = 0; k < first.size() && plane[p] == kNoPlane; ++k)
      if (SamePlane(patches[static_cast<std::size_t>(first[k])], patches[p]))
        plane[p] = static_cast<PlaneId>(k);
    if (plane[p] != kNoPlane) continue;
    plane[p] = static_cast<PlaneId>(first.size());
    first.push_back(static_cast<PatchId>(p));
  }
  std::vector<std::vector<PatchId>> on(first.size());
  for (std::size_t p = 0; p < patches.size(); ++p)
    on[static_cast<std::size_t>(plane[p])].push_back(static_cast<PatchId>(p));
  for (const std::vector<PatchId>& together : on)
    for (const PatchId a : together)
      for (const PatchId b : together)
        if (patches[static_cast<std::size_t>(a)].normal.dot(patches[static_cast<std::size_t>(b)].normal) < 0)
          reverse[static_cast<std::size_t>(a)].push_back(b);
}

void RayScene::Impl::Commit() {
  device = rtcNewDevice(nullptr);
  PENUMBRA_CHECK(device != nullptr);
  embree = rtcNewScene(device);
  rtcSetSceneFlags(embree, RTC_SCENE_FLAG_ROBUST);
  const std::size_t count = scene->patches.size();
  if (count > 0) {
    // Triangles are quads whose last two vertices coincide, as Embree documents.
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_QUAD);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4 * count));
    auto* index = static_cast<unsigned int*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(unsigned int), count));
    for (std::size_t i = 0; i < 4 * count; ++i) {
      const Vec3 v = scene->patches[i / 4].vertex[i % 4] - origin;
      for (std::size_t axis = 0; axis < 3; ++axis)
        vertex[3 * i + axis] = static_cast<float>(v[static_cast<int>(axis)]);
      index[i] = static_cast<unsigned int>(i);
    }
    rtcSetGeometryIntersectFilterFunction(geometry, &PassOwnPlanes);
    rtcSetGeometryOccludedFilterFunction(geometry, &PassOwnPlanes);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(embree);
}

RayScene::RayScene(const Scene& scene) : impl_(std::make_unique<Impl>()) {
  const auto [low, high] = scene.Bounds();
  impl_->scene = &scene;
  impl_->origin = 0.5 * (low + high);
  impl_->diagonal = (high - low).norm();
  impl_->half_extent = 0.5 * MaxAbs(high - low);
  impl_->FindPlanes();
  impl_->Commit();
}

RayScene::~RayScene() {
  rtcReleaseScene(impl_->embree);
  rtcReleaseDevice(impl_->device);
}

PlaneId RayScene::PlaneOf(PatchId patch) const { return impl_->plane[static_cast<std::size_t>(patch)]; }

double RayScene::Resolution() const { return 2 * 0x1p-24 * impl_->half_extent; }

PlaneId RayScene::PlaneAt(const Vec3& point) const {
  const std::vector<Patch>& patches = impl_->scene->patches;
  const double tolerance = kSamePlane * impl_->diagonal;
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (std::abs(patches[p].normal.dot(point - patches[p].vertex[0])) <= tolerance &&
        ConvexContains(patches[p].Vertices(), patches[p].normal, point, tolerance))
      return impl_->plane[p];
  return kNoPlane;
}

RayScene::Hit RayScene::Trace(const Vec3& from, PlaneId from_plane, const Vec3& direction) const {
  PlaneContext context = impl_->Context(from_plane, from_plane);
  RTCRayHit query{};
  query.ray = impl_->Ray(from, direction, std::numeric_limits<float>::infinity());
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->embree, &context.base, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};

  Hit hit;
  hit.patch = static_cast<PatchId>(query.hit.primID);
  const Patch& patch = impl_->scene->patches[query.hit.primID];
  const double slope = patch.normal.dot(direction);
  hit.front = slope < 0;
  // Floats say which patch; where on it is found in doubles, unless the ray all but lies in its plane.
  constexpr double kInPlane = 1e-7;
  const double distance = std::abs(slope) > kInPlane ? patch.normal.dot(patch.vertex[0] - from) / slope
                                                     : static_cast<double>(query.ray.tfar);
  hit.position = from + std::max(0.0, distance) * direction;
  if (hit.front) return hit;
  for (const PatchId other : impl_->reverse[query.hit.primID]) {
    const Patch& reverse = impl_->scene->patches[static_cast<std::size_t>(other)];
    if (!ConvexContains(reverse.Vertices(), reverse.normal, hit.position, 0)) continue;
    hit.patch = other;
    hit.front = true;
    break;
  }
  return hit;
}

bool RayScene::Blocked(const Vec3& from, PlaneId from_plane, const Vec3& to, PlaneId to_plane) const {
  PlaneContext context = impl_->Context(from_plane, to_plane);
  RTCRay ray = impl_->Ray(from, to - from, 1);
  rtcOccluded1(impl_->embree, &context.base, &ray);
  return ray.tfar < 0;
}

}  // namespace penumbra
