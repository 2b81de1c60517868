// solver/visibility/point/ray_caster.h
//
// Finds the nearest hits of rays in a scene by the library Embree, in its robust and watertight mode. Embree
// computes in single precision: use RayCaster only where errors for a few rays do not matter (escaped light,
// picking), never for exact visibility.

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "solver/scene/scene.h"

namespace penumbra {

class RayCaster {
 public:
  struct Hit {
    PatchId patch = kNoPatch;  // the patch that is hit; kNoPatch if the ray leaves the scene
    // The distance from the ray's origin to the hit, divided by the length of the direction vector.
    double distance = 0;
    bool front = false;  // true if the ray hit the front of the patch
  };

  explicit RayCaster(const Scene& scene);
  ~RayCaster();

  // Finds the first patch other than `ignore` that the ray from `origin` along `direction` hits. If two
  // patches with opposite fronts coincide, the patch whose front faces the ray is returned. Cast() may be
  // called from any thread.
  Hit Cast(const Vec3& origin, const Vec3& direction, PatchId ignore = kNoPatch) const;

  // True if a patch intersects the segment between the two points; fronts and backs both block. An end point
  // that lies on a patch must be moved off the patch by ContactGap() or more. Blocked() may be called from
  // any thread.
  bool Blocked(const Vec3& from, const Vec3& to) const;

  // The largest number of rays that CastTogether() and BlockedTogether() trace together.
  static constexpr std::size_t kPacket = 8;
  // Sets hits[i] to Cast(origins[i], direction). Parallel rays from neighbouring origins take a third of the
  // time of single rays. REQUIRES: there are at most kPacket origins, and as many hits as origins.
  // CastTogether() may be called from any thread.
  void CastTogether(std::span<const Vec3> origins, const Vec3& direction, std::span<Hit> hits) const;
  // Tests several segments: bit i of the result is Blocked(from[i], to[i]). REQUIRES: there are at most
  // kPacket segments. BlockedTogether() may be called from any thread.
  std::uint32_t BlockedTogether(std::span<const Vec3> from, std::span<const Vec3> to) const;

  // Finds the first patch whose front the ray hits; rays pass through the backs of patches, as in the display
  // (thesis 3.6, footnote 1). CastToFront() may be called from any thread.
  Hit CastToFront(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
