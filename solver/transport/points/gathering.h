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
  // The method that computes which part of a source is visible. Null selects the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // The thesis does not use one-sided limits, but moves points and sources slightly (6.3, 6.4, Appendix A).
  // The options nudge and source_push_off imitate the thesis, for comparison: a point with an approach
  // direction is moved along the approach by `nudge` [m], and sources are moved along the receiver's normal
  // by `source_push_off` [m].
  double nudge = 0;
  double source_push_off = 0;
  // If `method` is null and min_backprojection_segment is positive, the method is Backprojection, which
  // collapses segments of blockers' outlines that are shorter than min_backprojection_segment * (diameter of
  // the source's image).
  double min_backprojection_segment = 0;
  // PointIrradiance::NearlyOnPatch() multiplies its tolerance by part_of_tolerance [1]. In nearly white
  // rooms, the factor must be small: light that a sample omits is missing in each of many bounces.
  double part_of_tolerance = 1;
};

// The irradiance that a point receives from one patch.
struct PatchContribution {
  PatchId source = kNoPatch;
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
};

// The gradient of irradiance [W/m^3]: row c holds the derivatives of channel c with respect to x, y and z.
using IrradianceGradient = Eigen::Matrix3d;

// The parts of the irradiance at a point.
struct IrradianceParts {
  Rgb direct = Rgb::Zero();  // from emittance [W/m^2]
  // The gradient with respect to the position of the point, with a fixed normal. Edges through the point
  // contribute nothing to the gradient.
  IrradianceGradient gradient = IrradianceGradient::Zero();
  std::vector<PatchContribution>
      contributions;  // of the patches that light the point, in the order of AddSource()
};

// The fraction of a point's light that returns to the point after one reflection at `source`: the maximum
// over the channels of rho rho' F^2, where rho is the reflectance of `patch`, on which the point lies, rho'
// is the reflectance of `source`, and F = `factor` is the form factor of the point to `source`.
double SentBack(const Scene& scene, PatchId patch, PatchId source, double factor);

// The error that the terms of one source may cause, relative to `light`, the source's light without blockers:
// (1 - returned)^2 tolerance * (a fifth of `known` / light), for the channel where it is smallest. `known` is
// the irradiance of the point. A dim source may err more, since a point has many sources, whose errors have
// different signs; in a slot, where the fraction `returned` of the light comes back (SentBack), errors add
// up.
double AggregateTolerance(double tolerance, double returned, const Rgb& light, const Rgb& known);

// A Gathering must be a local variable, because it borrows its buffers from the thread that creates it
// (Scratch).
class Gathering {
 public:
  // If options.method is null, blockers are cut out of the whole quadtree of a source at once, which is
  // fastest. If options.method is not null, the method computes the form factor of every polygon that
  // blockers cover in part. `parts` may be null. All arguments must outlive the object.
  Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at,
            const PointIrradianceOptions& options, IrradianceParts* parts);
  ~Gathering();
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;

  // Adds the light of the patch `source`. The blockers are those candidates that lie between the point and
  // the source. `own`, the receiver's patch, does not block.
  void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own);
  // Like AddSource() above, with all patches of the hierarchy as candidates. `screens` are patches that may
  // hide large parts of the view.
  void AddSource(PatchId source, const PatchHierarchy& patches, std::span<const Screen> screens);

  // Makes subsequent calls of AddSource() add the form factor of each leaf l of the source set to factors[l].
  void RecordFactors(std::span<double> factors) { factors_ = factors; }

  // From now on, adds the sources and their terms to the row. REQUIRES: AllowAggregates() has been called,
  // and the options name no method.
  void RecordRow(FactorRow& row) { row_ = &row; }

  // Allows subsequent calls of AddSource() to replace a subtree of a source by an aggregate, one polygon with
  // one radiosity, for speed. The aggregates of a source may cause an error of about T max(L, c S), where L
  // is the unoccluded light of the source, S the light of all sources added earlier, c < 1 a constant, T = (1
  // - r)^2 * tolerance, and r the largest SentBack() of the sources added so far. Sources should therefore be
  // added in order of decreasing brightness. S is at
  // least `known`, the approximate irradiance of the point. At a point that is `mostly_hidden` from the
  // light, the error may be about T c S. REQUIRES: the point lies on a patch.
  void AllowAggregates(double tolerance, const Rgb& known = Rgb::Zero(), bool mostly_hidden = false);
  // The irradiance from the sources added so far if no blocker hid any part of them [W/m^2]. Sources that are
  // hidden completely are excluded. REQUIRES: AllowAggregates() was called.
  const Rgb& unhindered() const { return unhindered_; }
  // True if sources that contribute at most `light` in total may be omitted: in every channel, light <= T S /
  // 4, with T and S as in the comment on AllowAggregates().
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
  std::vector<Occluder>& occluders_;  // of the current source
  Scratch<Buffers> buffers_;
  Clipper& clipper_;  // one of the buffers
  double tolerance_ = 0;
  Rgb known_ = Rgb::Zero();       // approximate irradiance of the point; zero: unknown
  bool mostly_hidden_ = false;    // see AllowAggregates()
  Rgb unhindered_ = Rgb::Zero();  // see unhindered(); set if tolerance_ > 0
  Rgb so_far_ = Rgb::Zero();      // approximate light of the completed sources; set if tolerance_ > 0
  double returned_ = 0;           // largest SentBack() of the sources so far; set if tolerance_ > 0
  // Data of the current source, if tolerance_ > 0: the tolerance for its light, its normal, and the
  // unoccluded form factor of its polygon above the horizon.
  double tolerance_here_ = 0;
  Vec3 source_normal_ = Vec3::Zero();
  double whole_ = 0;
  double factor_ = 0;  // of the current source, so far
  Rgb irradiance_ = Rgb::Zero();
  std::span<double> factors_;  // for each leaf of the set; empty: not recorded
  FactorRow* row_ = nullptr;   // null: not recorded
};

}  // namespace penumbra
