// solver/visibility/point/ray_caster.h
//
// Nearest-hit rays through a scene (Embree, robust and watertight). Embree computes in float: use it where a
// measure-zero set of misses does not matter (escaped light, picking), never for exact visibility.

#pragma once

#include <memory>

#include "solver/scene/scene.h"

namespace penumbra {

class RayCaster {
 public:
  struct Hit {
    PatchId patch = kNoPatch;  // kNoPatch: the ray leaves the scene
    double distance = 0;       // along the direction as given, in its lengths
    bool front = false;        // whether the patch was hit on its front
  };

  explicit RayCaster(const Scene& scene);
  ~RayCaster();

  // Of two patches that lie on each other and look either way, the front is met.
  // The first patch that the ray from `origin` along `direction` meets, `ignore` left out. Safe from any
  // thread.
  Hit Cast(const Vec3& origin, const Vec3& direction, PatchId ignore = kNoPatch) const;

  // The first patch whose front the ray meets; backs are passed through, as if they were not there. So the
  // display sees (thesis 3.6, footnote 1). Safe from any thread.
  Hit CastToFront(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
