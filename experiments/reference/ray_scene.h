// experiments/reference/ray_scene.h
//
// Intersects rays with the patches of a scene by Embree, without any code of the solver. A patch does not
// block a ray that starts or ends in the patch's plane, whatever the rounding of floats. Where two patches
// with opposite fronts lie on each other, a ray hits the patch whose front it meets.

#pragma once

#include <cstdint>
#include <memory>

#include "solver/scene/scene.h"

namespace penumbra {

// A number for each plane that contains patches. Patches with opposite fronts in one plane have the same
// number.
using PlaneId = std::int32_t;
inline constexpr PlaneId kNoPlane = -1;

class RayScene {
 public:
  explicit RayScene(const Scene& scene);  // `scene` must outlive the object
  ~RayScene();

  PlaneId PlaneOf(PatchId patch) const;

  // Returns the plane of the patch with the lowest number that contains the point, within the resolution of
  // rays. The result is kNoPlane if no patch contains the point.
  PlaneId PlaneAt(const Vec3& point) const;

  // Returns the largest error of positions because of rounding to floats [m]. Rounding to floats moves a
  // vertex, and also the start of a ray, by at most 2^-24 * (half the scene's largest extent).
  double Resolution() const;

  struct Hit {
    PatchId patch = kNoPatch;      // patch that the ray hits; kNoPatch: the ray leaves the scene
    bool front = false;            // true if the ray hits the patch's front
    Vec3 position = Vec3::Zero();  // point on the patch's plane, computed in doubles
  };
  // Returns the first patch that a ray from a point of the plane `from_plane` hits. The direction of the ray
  // has unit length. Trace() and Blocked() may be called from any thread.
  Hit Trace(const Vec3& from, PlaneId from_plane, const Vec3& direction) const;

  // Returns true if a patch blocks the segment from a point of one plane to a point of another plane.
  bool Blocked(const Vec3& from, PlaneId from_plane, const Vec3& to, PlaneId to_plane) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
