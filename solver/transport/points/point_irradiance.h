// solver/transport/points/point_irradiance.h
//
// IrradianceAtPoint() (thesis, chapter 6): the irradiance at a point from the leaves of a solution, with
// exact form factors and exact visibility. Blockers are cut out of the sources, never sampled.
//
// Contact (thesis 6.3, 6.4) is handled as a limit, with no distance in it: where the point lies in the plane
// of a source or a blocker, the direction from which it is approached decides on which side it lies.

#pragma once

#include <memory>
#include <span>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/gathering.h"
#include "solver/transport/points/leaf_visibility.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

struct PointIrradianceResult {
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
  // The approach direction decided something: another side of this point may have another value, and samples
  // there must not be shared between triangles.
  bool one_sided = false;
};

class PointIrradiance {
 public:
  // From the leaves of a solution. What they see is found where it is not given. Everything referred to must
  // outlive this object.
  PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility,
                  const PointIrradianceOptions& options = {},
                  std::shared_ptr<const LeafVisibility> leaves = nullptr);
  // From any set of sources, with the sources and blockers that the patches have: direct light, say.
  PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources,
                  const PointIrradianceOptions& options = {});

  // The same view of the scene with other sources.
  PointIrradiance WithSources(SourceSet sources) const;

  // At a point on the front of a patch: only the sources of its leaf (or patch) and their blockers are looked
  // at, and the patch itself neither lights nor blocks. Safe from any thread.
  // If `parts` is not null it gets what the irradiance is made of.
  PointIrradianceResult OnPatch(PatchId patch, const ReceiverPoint& at,
                                IrradianceParts* parts = nullptr) const;

  // The same for interpolants: what is seen of a source may be seen as one of its mean radiosity where that
  // costs at most about `tolerance` of the light from there (Gathering::AllowAggregates).
  PointIrradianceResult NearlyOnPatch(PatchId patch, const ReceiverPoint& at, double tolerance) const;

  // The same as OnPatch(), and what each leaf of the source set contributes to it: `factors` gets their form
  // factors, seen parts only, by their number. REQUIRES: it has as many as there are leaves.
  Rgb OnPatch(PatchId patch, const ReceiverPoint& at, std::span<double> factors) const;

  const SourceSet& sources() const { return sources_; }

  // How many times light that arrives there counts by going to and fro between the patch and the wall that
  // sends back the most: 1 / (1 - rho rho' F^2), F the form factor to that wall as if nothing hid it, the
  // channel where it is most. At most 1.2 beside an edge of a room, 2.8 deep in a slot, at reflectances of
  // 0.8.
  double Reverberation(PatchId patch, const ReceiverPoint& at) const;

  // The patches that a leaf of the solution sees. REQUIRES: made from a solution.
  std::span<const PatchPair> SeenFrom(ElementId leaf) const { return leaves_->SourcesOf(leaf); }

  // Anywhere, in free space too: every patch may light and block, and a hierarchy finds those that do. Safe
  // from any thread.
  PointIrradianceResult Anywhere(const ReceiverPoint& at, IrradianceParts* parts = nullptr) const;

 private:
  void BuildHierarchies();
  void ChooseMethod();
  void GatherOnPatch(PatchId patch, const ReceiverPoint& at, Gathering& gathering) const;
  void GatherBrightestFirst(PatchId patch, const ReceiverPoint& at, Gathering& gathering) const;
  // The form factor of a source of that patch that nothing hides.
  struct UnhinderedFactor {
    double about, most;
  };
  UnhinderedFactor FactorUnhindered(const SourceSet::Node& source, PatchId patch,
                                    const ReceiverPoint& at) const;
  ReceiverPoint Nudged(const ReceiverPoint& at) const;

  const Scene& scene_;
  const PatchVisibility& visibility_;
  const ElementForest* forest_ = nullptr;  // whose leaves leaves_ knows; null without a solution
  SourceSet sources_;
  std::shared_ptr<const LeafVisibility> leaves_;
  PointIrradianceOptions options_;
  std::shared_ptr<const OcclusionMethod> method_;  // what options_ names, if it is ours
  PatchHierarchy patches_;                         // all of them
  PatchHierarchy source_patches_;                  // those that send light
  ScreenFinder screens_;
};

}  // namespace penumbra
