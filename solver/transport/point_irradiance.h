// solver/transport/point_irradiance.h
//
// IrradianceAtPoint() (thesis, chapter 6): the irradiance at a point from the leaves of a solution, with exact form
// factors and exact visibility. Blockers are cut out of the sources, never sampled.
//
// Contact (thesis 6.3, 6.4) is handled as a limit, with no distance in it: where the point lies in the plane of a
// source or a blocker, the direction from which it is approached decides on which side it lies.

#pragma once

#include <memory>
#include <span>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/source_set.h"
#include "solver/visibility/patch_visibility.h"

namespace penumbra {

// Where irradiance is asked for.
struct ReceiverPoint {
  Vec3 position = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();   // unit
  // The direction from the point towards the region that asks, for a one-sided limit; need not be unit. Zero: the
  // integral itself, to which a polygon whose plane contains the point adds nothing and from which it takes nothing.
  Vec3 approach = Vec3::Zero();
  // How far the position may be from where it is meant to be [m], beside the rounding of its coordinates. Planes
  // within this distance are taken to contain the point. 0 for points that users give.
  double uncertainty = 0;
};

struct PointIrradianceResult {
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
  // The approach direction decided something: another side of this point may have another value, and samples there
  // must not be shared between triangles.
  bool one_sided = false;
};

class PointIrradiance {
 public:
  // Everything referred to must outlive this object.
  PointIrradiance(const Scene& scene, const PatchVisibility& visibility, const SourceSet& sources);
  ~PointIrradiance();
  PointIrradiance(PointIrradiance&&) noexcept;

  // At a point on the front of a patch: only the patch's sources and their blockers are looked at, and the patch
  // itself neither lights nor blocks. Safe from any thread.
  PointIrradianceResult OnPatch(PatchId patch, const ReceiverPoint& at) const;

  // Anywhere, in free space too: every patch may light and block. Safe from any thread.
  PointIrradianceResult Anywhere(const ReceiverPoint& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
