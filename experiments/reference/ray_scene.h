// experiments/reference/ray_scene.h
//
// The scene as rays see it (Embree), and nothing of it from the solver. Patches that share a plane block
// nothing that starts or ends in that plane, however floats round; where two patches lie on each other, one
// looking either way, the one that looks towards the ray is met.

#pragma once

#include <cstdint>
#include <memory>

#include "solver/scene/scene.h"

namespace penumbra {

// A number for each plane that holds patches, whichever way they look.
using PlaneId = std::int32_t;
inline constexpr PlaneId kNoPlane = -1;

class RayScene {
 public:
  explicit RayScene(const Scene& scene);  // the scene must outlive it
  ~RayScene();

  PlaneId PlaneOf(PatchId patch) const;

  // The plane of the lowest patch that contains the point, to the resolution of the rays; kNoPlane if none
  // does.
  PlaneId PlaneAt(const Vec3& point) const;

  // How far positions may be off in floats [m]: 2^-24 of half the scene's largest extent for a vertex and for
  // the start of a ray each.
  double Resolution() const;

  struct Hit {
    PatchId patch = kNoPatch;      // kNoPatch: the ray leaves the scene
    bool front = false;            // whether the patch was met on its front
    Vec3 position = Vec3::Zero();  // on the patch's plane, in doubles
  };
  // The first patch that a ray from a point of the plane meets. The direction is unit. Safe from any thread.
  Hit Trace(const Vec3& from, PlaneId from_plane, const Vec3& direction) const;

  // Whether something stands between a point of one plane and a point of another. Safe from any thread.
  bool Blocked(const Vec3& from, PlaneId from_plane, const Vec3& to, PlaneId to_plane) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
