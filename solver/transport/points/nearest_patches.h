// solver/transport/points/nearest_patches.h

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// Finds, among the patches that a polygon sees, those patches that may be the nearest patch to some point of
// the polygon. The distance to the nearest patch bounds the solid angle that the polygon subtends at points
// of other patches.
class NearestPatches {
 public:
  // The scene must outlive the NearestPatches object.
  NearestPatches(const Scene& scene, std::span<const Vec3> polygon, std::span<const PatchPair> seen);

  std::span<const PatchId> patches() const { return patches_; }
  // The distance from the point to the nearest point of the patch [m].
  double DistanceTo(PatchId patch, const Vec3& point) const;
  // The distance from the point to the nearest patch in patches() [m]; infinite if patches() is empty.
  double Distance(const Vec3& point) const;

 private:
  const Scene* scene_;
  std::vector<PatchId> patches_;
};

}  // namespace penumbra
