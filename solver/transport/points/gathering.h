// solver/transport/points/gathering.h
//
// Computes the irradiance at one receiver point from the sources of a SourceSet, patch by patch.

#pragma once

#include <span>
#include <vector>

#include "solver/base/scratch.h"
#include "solver/transport/points/factor_row.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {

struct PointIrradianceOptions {
  // The method that computes which part of a source is visible. If `method` is null, the fastest exact
  // visibility method is used.
  const OcclusionMethod* method = nullptr;
  // Where surfaces touch, the thesis does not use one-sided limits of irradiance, but moves points and
  // sources slightly (6.3, 6.4, Appendix A). The options `nudge` and `source_push_off` imitate the thesis,
  // for comparison. `nudge` is the distance [m] by which a point is moved in the direction of its one-sided
  // limit (ReceiverPoint::approach). `source_push_off` is the distance by which sources are moved along the
  // receiver's normal [m].
  double nudge = 0;
  double source_push_off = 0;
  // If `method` is null and min_backprojection_segment is positive, the visibility method is Backprojection.
  // Backprojection collapses segments of blockers' outlines that are shorter than min_backprojection_segment
  // * (diameter of the source's image).
  double min_backprojection_segment = 0;
  // PointIrradiance::NearlyOnPatch() multiplies its tolerance by part_of_tolerance [1]. In nearly white
  // rooms, part_of_tolerance must be small, because light that a sample omits is missing in each of many
  // bounces.
  double part_of_tolerance = 1;
};

// The irradiance that a point receives from one patch.
struct PatchContribution {
  PatchId source = kNoPatch;
  Rgb irradiance = Rgb::Zero();  // irradiance that the patch brings to the point [W/m^2]
};

// The gradient of irradiance [W/m^3]: row c holds the derivatives of channel c with respect to x, y and z.
using IrradianceGradient = Eigen::Matrix3d;

// Details of the irradiance at a point: the direct light, the gradient, and the contribution of each patch.
struct IrradianceParts {
  Rgb direct = Rgb::Zero();  // irradiance from emitted light, without reflection [W/m^2]
  // The gradient of irradiance with respect to the position of the point, with a fixed normal. Edges of
  // surfaces that pass through the point contribute nothing to the gradient.
  IrradianceGradient gradient = IrradianceGradient::Zero();
  // The contributions of the patches that light the point, in the order of the calls of AddSource().
  std::vector<PatchContribution> contributions;
};

// The fraction of a point's light that returns to the point after one reflection at the patch `source`: the
// maximum over the channels of rho rho' F^2, where rho is the reflectance of `patch`, on which the point
// lies, rho' is the reflectance of `source`, and F = `factor` is the form factor of the point to `source`.
double SentBack(const Scene& scene, PatchId patch, PatchId source, double factor);

// The allowed error of the light of one source, relative to `light`, the source's irradiance without
// blockers. The allowed error of a source's light is (1 - returned)^2 * tolerance * (known / light) / 5, in
// the channel where it is smallest; `known` is the irradiance of the point. A dim source may have a larger
// relative error than a bright source, since a point has many sources, whose errors have different signs. In
// a narrow slot, a large fraction `returned` of the light returns to its origin (SentBack), so that errors
// add up.
double AggregateTolerance(double tolerance, double returned, const Rgb& light, const Rgb& known);

// Computes the irradiance at one point, source by source. A Gathering must be a local variable, because the
// Gathering borrows buffers from the thread that creates it (Scratch).
class Gathering {
 public:
  // If options.method is null, blockers are cut out of the whole quadtree of a source at once, which is
  // fastest. If options.method is not null, *options.method computes the form factor of every source polygon
  // that blockers hide in part. `parts` may be null. All arguments must outlive the Gathering.
  Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at,
            const PointIrradianceOptions& options, IrradianceParts* parts);
  ~Gathering();
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;

  // Adds the light of the patch `source` to the irradiance at the point. Those patches of `candidates` that
  // lie between the point and the source block light. The patch `own`, on which the receiver point lies, does
  // not block light.
  void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own);
  // Adds the light of the patch `source` to the irradiance; all patches in the bounding volume hierarchy
  // `patches` may block light. `screens` are patches that may hide large parts of the view at once.
  void AddSource(PatchId source, const PatchHierarchy& patches, std::span<const Screen> screens);

  // Makes subsequent calls of AddSource() add the form factor of each leaf l of the source set to factors[l].
  void RecordFactors(std::span<double> factors) { factors_ = factors; }

  // Makes subsequent calls of AddSource() append the form factors of the source to `row`. REQUIRES:
  // AllowAggregates() has been called, and PointIrradianceOptions::method is null.
  void RecordRow(FactorRow& row) { row_ = &row; }

  // Allows subsequent calls of AddSource() to replace a subtree of a source by an aggregate, one polygon with
  // one radiosity, for speed. Aggregates (polygons that replace subtrees of a source) may change the light of
  // the source by about tolerance * max(unoccluded light of the source, c * light of all sources added
  // earlier), with a constant c < 1. Gathering multiplies the tolerance of aggregates by (1 - r)^2, where r
  // is the largest SentBack() of the sources added so far. Because the allowed error grows with the light of
  // earlier sources, sources should be added in order of decreasing brightness. If `known`, the approximate
  // irradiance of the point, exceeds the light of all sources added earlier, `known` replaces this light in
  // the allowed error. If `mostly_hidden` is true, blockers hide most of the light at the point, and the
  // allowed error does not depend on the unoccluded light of the source. REQUIRES: the point lies on a patch.
  void AllowAggregates(double tolerance, const Rgb& known = Rgb::Zero(), bool mostly_hidden = false);
  // The irradiance that the sources added so far would give without blockers [W/m^2]. unhindered() excludes
  // sources that blockers hide completely. REQUIRES: AllowAggregates() was called.
  const Rgb& unhindered() const { return unhindered_; }
  // True if sources that contribute at most `light` in total may be omitted: in every channel, `light` is at
  // most (1 - r)^2 * tolerance / 4 * (light of the sources added so far), with r and tolerance as in
  // AllowAggregates().
  bool IsNegligible(const Rgb& light) const;

  const Rgb& irradiance() {
    AddListedSources();
    return irradiance_;
  }
  bool one_sided() const { return view_.one_sided(); }

 private:
  using Tree = std::span<const SourceSet::Node>;
  struct Buffers;

  bool Face(PatchId source, DirectionPolygon* seen);
  bool HiddenBy(std::span<const Screen> screens, const DirectionPolygon& seen);
  void Gather(PatchId source, const DirectionPolygon& seen, std::span<const PatchId> candidates, PatchId own);
  void EndSourceOfRow(PatchId source, std::size_t first_term);
  void GatherShadowed(Tree tree, std::size_t i);
  ImagePolygon ImageOf(const SourceSet::Node& node, const ImageFrame& frame) const;
  void GatherNode(Tree tree, std::size_t i, const ImageFrame& frame, const Clipper::Candidates& candidates);
  void GatherVisible(Tree nodes);
  void GatherAggregates(Tree nodes);
  double Tolerance() const;
  double ToleranceFor(const Rgb& light) const;
  bool MayAggregate(const SourceSet::Node& node, bool visible) const;
  double Nearness(const SourceSet::Node& node) const;
  Vec3 FirstMoment(const SourceSet::Node& node) const;
  void AddListedSources();
  void GatherUnfit(const SourceSet::Node& leaf, const DirectionPolygon& seen);
  void AddVisiblePieces(const ImageFrame& frame, double visible_before);
  double CancellationAllowed() const;
  void AddGradientOfPieces(const ImageFrame& frame);
  void Add(std::int32_t leaf, double factor);
  void Add(const FactorTerm& term);
  void Record(const FactorTerm& term);
  Vec3 OffsetToward(const SourceSet::Node& node, const Vec3& direction) const;
  void AddGradient(std::int32_t leaf, const Vec3& gradient);

  const Scene& scene_;
  const SourceSet& sources_;
  const ReceiverPoint& at_;
  const OcclusionMethod* method_;
  IrradianceParts* parts_;
  PointView view_;
  std::vector<Occluder>& occluders_;  // blockers, as cones of directions, that may hide the current source
  Scratch<Buffers> buffers_;
  Clipper& clipper_;  // the Clipper object in buffers_
  double tolerance_ = 0;
  Rgb known_ = Rgb::Zero();     // approximate irradiance of the point; zero if it is unknown
  bool mostly_hidden_ = false;  // true if blockers hide most of the light at the point; see AllowAggregates()
  Rgb unhindered_ = Rgb::Zero();  // irradiance without blockers, unhindered(); set if tolerance_ > 0
  Rgb so_far_ = Rgb::Zero();  // approximate irradiance from the sources added so far; set if tolerance_ > 0
  // The largest fraction of the point's light that a source added so far sends back to the point (SentBack);
  // set if tolerance_ > 0.
  double returned_ = 0;
  // Data of the current source, if tolerance_ > 0: the tolerance for the source's light, the source's normal,
  // and the unoccluded form factor of the source's part above the horizon.
  double tolerance_here_ = 0;
  Vec3 source_normal_ = Vec3::Zero();
  double whole_ = 0;
  double factor_ = 0;  // form factor to the visible part of the current source, summed up so far
  Rgb irradiance_ = Rgb::Zero();
  std::span<double> factors_;  // form factor to each leaf of the source set; empty if not recorded
  FactorRow* row_ = nullptr;   // the FactorRow to which form factors are appended; null if none
};

}  // namespace penumbra
