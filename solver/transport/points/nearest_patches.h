// solver/transport/points/nearest_patches.h

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The patches that may be the nearest to some point of a polygon, among those that the polygon sees: how near
// they are says how much of their view the polygon can fill.
class NearestPatches {
 public:
  // The scene must outlive the object.
  NearestPatches(const Scene& scene, std::span<const Vec3> polygon, std::span<const PatchPair> seen);

  std::span<const PatchId> patches() const { return patches_; }
  // From the point to the nearest point of the patch [m].
  double DistanceTo(PatchId patch, const Vec3& point) const;
  // From the point to the nearest of all patches [m]; infinite if there are none.
  double Distance(const Vec3& point) const;

 private:
  const Scene* scene_;
  std::vector<PatchId> patches_;
};

}  // namespace penumbra
