// solver/transport/points/point_irradiance.h
//
// The irradiance at a point from the leaves of a radiosity solution, with exact form factors and exact
// visibility (the thesis's IrradianceAtPoint, chapter 6). Blockers are cut out of the sources analytically,
// without sampling. Only if RadiositySolution::rays_per_point is positive, rays sample the irradiance instead
// (FinalGather).
//
// At contacts, where surfaces touch, the irradiance is a one-sided limit (thesis 6.3, 6.4). The one-sided
// limit is computed without a small offset: if the plane of a source or a blocker contains the point, the
// point's approach direction decides on which side of the plane the point lies.

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
  Rgb irradiance = Rgb::Zero();  // irradiance at the point [W/m^2]
  // True if the irradiance is a one-sided limit, which depends on the direction from which the point is
  // approached. Triangles on different sides of a contact (line where another surface touches) must not share
  // a one-sided irradiance sample, because their one-sided limits may differ.
  bool one_sided = false;
  // The form factors from which the irradiance was computed; null if they were not requested.
  std::shared_ptr<FactorRow> row = nullptr;
  // The standard error of the irradiance [W/m^2]; 0 if no independent samples give a standard error.
  Rgb deviation = Rgb::Zero();
};

// Light sources of some patches, divided into smaller polygons than the leaves of the solution, for points so
// close to a patch that the variation of radiosity within a leaf matters.
struct DividedSources {
  std::vector<PatchId> patches;  // patches whose sources are replaced, in ascending order
  SourceSet sources;             // the divided sources of `patches`, and of no other patches
};

// A point on the front of a patch.
struct PatchPoint {
  PatchId patch = kNoPatch;
  ReceiverPoint at;
};

class PointIrradiance {
 public:
  // Computes irradiance from the leaves of a radiosity solution. If `leaves` is null, the constructor
  // computes the visibility of the leaves. All arguments passed by reference must outlive the
  // PointIrradiance.
  PointIrradiance(const RadiositySolution& solution, const PatchVisibility& visibility,
                  const PointIrradianceOptions& options = {},
                  std::shared_ptr<const LeafVisibility> leaves = nullptr);
  // Computes irradiance from any set of sources, such as the emitters. For a point on a patch, `visibility`
  // lists the sources and blockers to be tested.
  PointIrradiance(const Scene& scene, const PatchVisibility& visibility, SourceSet sources,
                  const PointIrradianceOptions& options = {});

  // A copy of this PointIrradiance with other sources.
  PointIrradiance WithSources(SourceSet sources) const;

  // The irradiance at a point on the front of a patch. OnPatch() tests only the sources that the leaf at the
  // point may see, and the blockers of these sources. If the PointIrradiance was made without a solution,
  // OnPatch() tests the sources and blockers that the patch may see. The patch itself neither lights the
  // point nor blocks light. If `parts` is not null, OnPatch() stores the direct light, the gradient and the
  // contribution of each patch in `parts`. Any thread may call OnPatch().
  PointIrradianceResult OnPatch(PatchId patch, const ReceiverPoint& at,
                                IrradianceParts* parts = nullptr) const;

  // Like OnPatch(), but with a relative error of about `tolerance`, for the samples of interpolants. A
  // subtree of a source may be replaced by one polygon with one radiosity if this changes the light of the
  // source by a fraction of at most about `tolerance` (Gathering::AllowAggregates).
  PointIrradianceResult NearlyOnPatch(PatchId patch, const ReceiverPoint& at, double tolerance) const;

  // True if rays sample the irradiance (RadiositySolution::rays_per_point > 0).
  bool IsSampled() const { return gather_.has_value(); }
  // Sets results[i] to the irradiance at points[i], in parallel. Rays of neighbouring points are traced
  // together, which takes less time than a call of NearlyOnPatch() for each point. Values of SampleTogether()
  // differ from those of NearlyOnPatch() only because neighbouring points send shadow rays to the same places
  // on weak emitters (ShadowRays). The sampled values do not depend on the number of threads. REQUIRES:
  // IsSampled() is true, and `points` and `results` have equal sizes.
  void SampleTogether(std::span<const PatchPoint> points, std::span<PointIrradianceResult> results) const;

  // Like NearlyOnPatch(), but also sets PointIrradianceResult::row to the form factors of the point, if
  // CanRecord() is true. Every source that lights the point, however dim, has terms in the row of form
  // factors.
  PointIrradianceResult RecordOnPatch(PatchId patch, const ReceiverPoint& at, double tolerance) const;
  bool CanRecord() const { return options_.method == nullptr && forest_ != nullptr && !gather_; }
  // Brings a row of form factors up to date with the present radiosities of sources(). Renew() computes the
  // form factors of a source anew if the error of the source's light would exceed a few times `tolerance`
  // because radiosity varies too much over a node of the source, or if FactorTerm::node is -1 for a term of
  // the source. Renew() also adds the form factors of the patches in `new_sources` to the row. Renew()
  // returns the number of sources whose form factors were computed anew. REQUIRES: CanRecord() is true.
  std::size_t Renew(PatchId patch, const ReceiverPoint& at, double tolerance,
                    std::span<const PatchId> new_sources, FactorRow& row) const;

  // Returns the same irradiance as OnPatch(), and sets factors[i] to the form factor of the visible part of
  // leaf i of the source set. REQUIRES: factors.size() is the number of leaves of the source set.
  Rgb OnPatch(PatchId patch, const ReceiverPoint& at, std::span<double> factors) const;

  const SourceSet& sources() const { return sources_; }

  // The patches that a leaf of the solution sees. REQUIRES: this PointIrradiance was made from a solution.
  std::span<const PatchPair> SeenFrom(ElementId leaf) const { return leaves_->SourcesOf(leaf); }

  // The irradiance at any point, also in free space. Any patch may light the point or block light; a bounding
  // volume hierarchy finds the patches that matter. If `divided` is not null, the sources in `divided`
  // replace the sources of the patches that `divided` lists. Any thread may call Anywhere().
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
    Rgb arrives = Rgb::Zero(), unhindered = Rgb::Zero();  // irradiance with and without blockers [W/m^2]
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
  const ElementForest* forest_ = nullptr;  // quadtrees of the solution; null if there is no solution
  SourceSet sources_;
  std::shared_ptr<const LeafVisibility> leaves_;
  PointIrradianceOptions options_;
  // the visibility method in options_, if this PointIrradiance made the method
  std::shared_ptr<const OcclusionMethod> method_;
  PatchHierarchy patches_;         // bounding volumes of all patches of the scene
  PatchHierarchy source_patches_;  // bounding volumes of the patches that send light
  ScreenFinder screens_;
  // Set only if RadiositySolution::rays_per_point > 0: gather_ serves NearlyOnPatch(), and closer_gather_,
  // with more rays, serves all other functions.
  std::optional<FinalGather> gather_, closer_gather_;
};

}  // namespace penumbra
