// solver/transport/point_irradiance.h
//
// IrradianceAtPoint() (thesis, chapter 6): the irradiance at a point from the leaves of a solution, with
// exact form factors and exact visibility. Blockers are cut out of the sources, never sampled.
//
// Contact (thesis 6.3, 6.4) is handled as a limit, with no distance in it: where the point lies in the plane
// of a source or a blocker, the direction from which it is approached decides on which side it lies.

#pragma once

#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/leaf_visibility.h"
#include "solver/transport/source_set.h"
#include "solver/visibility/patch_visibility.h"
#include "solver/visibility/receiver_point.h"

namespace penumbra {

struct PointIrradianceResult {
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
  // The approach direction decided something: another side of this point may have another value, and samples
  // there must not be shared between triangles.
  bool one_sided = false;
};

class PointIrradiance {
 public:
  // From the leaves of a solution. Everything referred to must outlive this object.
  PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility);
  // From any set of sources, with the sources and blockers that the patches have: direct light, say.
  PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources);

  // At a point on the front of a patch: only the sources of its leaf (or patch) and their blockers are looked
  // at, and the patch itself neither lights nor blocks. Safe from any thread.
  PointIrradianceResult OnPatch(PatchId patch, const ReceiverPoint& at) const;

  // Anywhere, in free space too: every patch may light and block. Safe from any thread.
  PointIrradianceResult Anywhere(const ReceiverPoint& at) const;

 private:
  const Scene& scene_;
  const PatchVisibility& visibility_;
  const ElementForest* forest_ = nullptr;  // whose leaves leaves_ knows; null without a solution
  SourceSet sources_;
  LeafVisibility leaves_;
  std::vector<PatchId> all_patches_;
};

}  // namespace penumbra
