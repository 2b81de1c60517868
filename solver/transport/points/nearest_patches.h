// solver/transport/points/nearest_patches.h

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// Among the patches that a polygon sees, those that may be the nearest ones to some point of the polygon. The
// distances of patches() bound the solid angle that the polygon fills as seen from other patches.
class NearestPatches {
 public:
  // The scene must outlive the object.
  NearestPatches(const Scene& scene, std::span<const Vec3> polygon, std::span<const PatchPair> seen);

  std::span<const PatchId> patches() const { return patches_; }
  // The distance from the point to the nearest point of the patch [m].
  double DistanceTo(PatchId patch, const Vec3& point) const;
  // The distance from the point to the nearest of patches() [m]; infinite if patches() is empty.
  double Distance(const Vec3& point) const;

 private:
  const Scene* scene_;
  std::vector<PatchId> patches_;
};

}  // namespace penumbra
