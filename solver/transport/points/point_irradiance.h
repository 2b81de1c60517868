// solver/transport/points/point_irradiance.h
//
// IrradianceAtPoint() (thesis, chapter 6): the irradiance at a point from the leaves of a solution, with
// exact form factors and exact visibility. Blockers are cut out of the sources, never sampled, unless the
// solution says otherwise (RadiositySolution::rays_per_point): then FinalGather gives the irradiance.
//
// At contacts (thesis 6.3, 6.4), the irradiance is a one-sided limit, and no small distance is involved: if
// the plane of a source or a blocker contains the point, the point's approach direction decides on which side
// of the plane the point lies.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/scene/scene.h"
#include "solver/transport/points/factor_row.h"
#include "solver/transport/points/final_gather.h"
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
  // True if the irradiance is a limit that depends on the approach direction. A one-sided limit may be
  // different for another approach direction; triangles on different sides of a contact must therefore not
  // share a one-sided sample.
  bool one_sided = false;
  // The form factors that led to the value; null if they were not asked for.
  std::shared_ptr<FactorRow> row = nullptr;
  // The standard error of the irradiance, as far as it is known from independent samples [W/m^2].
  Rgb deviation = Rgb::Zero();
};

// Sources that stand for those of some patches, at points that need them finer.
struct DividedSources {
  std::vector<PatchId> patches;  // in ascending order
  SourceSet sources;             // of these patches only
};

// A point on the front of a patch.
struct PatchPoint {
  PatchId patch = kNoPatch;
  ReceiverPoint at;
};

class PointIrradiance {
 public:
  // Irradiance from the leaves of a solution. If `leaves` is null, the constructor computes the visibility of
  // the leaves. All arguments passed by reference must outlive the object.
  PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility,
                  const PointIrradianceOptions& options = {},
                  std::shared_ptr<const LeafVisibility> leaves = nullptr);
  // Irradiance from any set of sources, such as the emitters. For a point on a patch, `visibility` gives the
  // sources and blockers to be tested.
  PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources,
                  const PointIrradianceOptions& options = {});

  // A copy of this object with other sources.
  PointIrradiance WithSources(SourceSet sources) const;

  // The irradiance at a point on the front of a patch. Tests only the sources that the leaf at the point may
  // see and their blockers; without a solution, those that the patch may see. The patch itself neither lights
  // nor blocks. If `parts` is not null, sets it to the parts of the irradiance. May be called from any
  // thread.
  PointIrradianceResult OnPatch(PatchId patch, const ReceiverPoint& at,
                                IrradianceParts* parts = nullptr) const;

  // Like OnPatch(), but within a relative tolerance; for the samples of interpolants. A subtree of a source
  // may be replaced by one polygon with one radiosity if this changes the light of the source by a fraction
  // of at most about `tolerance` (Gathering::AllowAggregates).
  PointIrradianceResult NearlyOnPatch(PatchId patch, const ReceiverPoint& at, double tolerance) const;

  // True if rays give the irradiance (RadiositySolution::rays_per_point > 0).
  bool IsSampled() const { return gather_.has_value(); }
  // Sets results[i] to the irradiance at points[i], in parallel. Rays of neighbouring points are traced
  // together, which takes less time than NearlyOnPatch() for each point. The values differ from those of
  // NearlyOnPatch() only because neighbours share the choice of weak luminaires (ShadowRays); they do not
  // depend on the number of threads.
  // REQUIRES: IsSampled(), and the sizes are equal.
  void SampleTogether(std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) const;

  // NearlyOnPatch(), and the row of form factors in the result, if CanRecord(). Every source that lights the
  // point has terms in the row, however dim.
  PointIrradianceResult RecordOnPatch(PatchId patch, const ReceiverPoint& at, double tolerance) const;
  bool CanRecord() const { return options_.method == nullptr && forest_ != nullptr && !gather_; }
  // Replaces, in a row of these sources, the terms of sources that do not hold to a few times the tolerance
  // for the present radiosities: since a node's radiosity varies too much, or a term has no node (-1). Adds
  // the terms of `new_sources`. Returns the number of sources that were gathered. REQUIRES: CanRecord().
  std::size_t Renew(PatchId patch, const ReceiverPoint& at, double tolerance,
                    std::span<const PatchId> new_sources, FactorRow& row) const;

  // Returns the same irradiance as OnPatch(), and sets factors[i] to the form factor of the visible part of
  // leaf i of the source set. REQUIRES: factors.size() is the number of leaves of the source set.
  Rgb OnPatch(PatchId patch, const ReceiverPoint& at, std::span<double> factors) const;

  const SourceSet& sources() const { return sources_; }

  // The patches that a leaf of the solution sees. REQUIRES: the object was made from a solution.
  std::span<const PatchPair> SeenFrom(ElementId leaf) const { return leaves_->SourcesOf(leaf); }

  // The irradiance at any point, also in free space. Any patch may light the point or block light; a bounding
  // volume hierarchy finds the patches that matter. If `divided` is not null, it gives the light of the
  // patches that it names. May be called from any thread.
  PointIrradianceResult Anywhere(const ReceiverPoint& at, IrradianceParts* parts = nullptr,
                                 const DividedSources* divided = nullptr) const;

 private:
  void BuildHierarchies();
  void ChooseMethod();
  void GatherOnPatch(PatchId patch, const ReceiverPoint& at, Gathering& gathering) const;
  enum class DimSources : std::uint8_t { kLeaveOut, kGather };
  void GatherBrightestFirst(PatchId patch, const ReceiverPoint& at, DimSources dim,
                            Gathering& gathering) const;
  struct KnownLight {
    Rgb arrives = Rgb::Zero(), unhindered = Rgb::Zero();  // with and without blockers [W/m^2]
    bool mostly_hidden = false;
  };
  KnownLight LightOf(const FactorRow& row) const;
  bool Holds(const FactorRow& row, const FactorRow::Source& source, const KnownLight& light,
             double tolerance) const;
  // An estimate and an upper bound of the unoccluded form factor of a point to a source on a patch.
  struct UnhinderedFactor {
    double about, most;
  };
  UnhinderedFactor FactorUnhindered(const SourceSet::Node& source, PatchId patch,
                                    const ReceiverPoint& at) const;
  ReceiverPoint Nudged(const ReceiverPoint& at) const;

  const Scene& scene_;
  const PatchVisibility& visibility_;
  const ElementForest* forest_ = nullptr;  // the forest of leaves_; null without a solution
  SourceSet sources_;
  std::shared_ptr<const LeafVisibility> leaves_;
  PointIrradianceOptions options_;
  std::shared_ptr<const OcclusionMethod> method_;  // the method that options_ names, if this object made it
  PatchHierarchy patches_;                         // all patches
  PatchHierarchy source_patches_;                  // the patches that send light
  ScreenFinder screens_;
  // For solutions with RadiositySolution::rays_per_point only: what NearlyOnPatch() returns, and all others.
  std::optional<FinalGather> gather_, closer_gather_;
};

}  // namespace penumbra
