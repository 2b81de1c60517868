// solver/visibility/point/ray_caster.h
//
// Nearest-hit rays through a scene (Embree, robust and watertight). Embree computes in float: use RayCaster
// where missing a set of rays of measure zero does not matter (escaped light, picking), never for exact
// visibility.

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
    PatchId patch = kNoPatch;  // kNoPatch: the ray leaves the scene
    double distance = 0;       // in units of the length of the given direction
    bool front = false;        // the ray hit the front of the patch
  };

  explicit RayCaster(const Scene& scene);
  ~RayCaster();

  // The first patch other than `ignore` that the ray from `origin` along `direction` hits. If two patches
  // with opposite fronts coincide, the hit is the one whose front faces the ray. May be called from any
  // thread.
  Hit Cast(const Vec3& origin, const Vec3& direction, PatchId ignore = kNoPatch) const;

  // True if a patch, seen from either side, crosses the segment between the two points. An end that lies on a
  // patch must be moved off it by ContactGap() or more. May be called from any thread.
  bool Blocked(const Vec3& from, const Vec3& to) const;

  // The largest number of rays of a packet.
  static constexpr std::size_t kPacket = 8;
  // Sets hits[i] to Cast(origins[i], direction). Parallel rays from neighbouring origins take a third of the
  // time of single rays. REQUIRES: at most kPacket origins, as many hits. May be called from any thread.
  void CastTogether(std::span<const Vec3> origins, const Vec3& direction, std::span<Hit> hits) const;
  // Bit i of the result tells whether the segment from from[i] to to[i] is Blocked(). REQUIRES: at most
  // kPacket segments. May be called from any thread.
  std::uint32_t BlockedTogether(std::span<const Vec3> from, std::span<const Vec3> to) const;

  // The first patch whose front the ray hits; rays pass through backs, as in the display (thesis 3.6,
  // footnote 1). May be called from any thread.
  Hit CastToFront(const Vec3& origin, const Vec3& direction) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
