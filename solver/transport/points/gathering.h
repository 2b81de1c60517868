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
  // Computes the part of a source that blockers leave visible. Null: the fastest exact method.
  const OcclusionMethod* method = nullptr;
  // The thesis's substitutes for limits (6.3, 6.4, Appendix A), for comparison. A point with an approach is
  // moved along the approach by `nudge` [m]. Sources are lifted along the receiver's normal by
  // `source_push_off` [m].
  double nudge = 0;
  double source_push_off = 0;
  // If `method` is null and this is positive, the method is Backprojection, which collapses segments of
  // blockers' outlines shorter than this times the source's diameter as seen.
  double min_backprojection_segment = 0;
  // PointIrradiance::NearlyOnPatch() multiplies its tolerance by this factor [1]. The light that a sample
  // leaves out is missing in every bounce, and rooms that are nearly white have many bounces.
  double part_of_tolerance = 1;
};

// The irradiance that a point receives from one patch.
struct PatchContribution {
  PatchId source = kNoPatch;
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
};

// One row for each channel: the derivatives of its irradiance by x, y and z [W/m^3].
using IrradianceGradient = Eigen::Matrix3d;

// The parts of the irradiance at a point.
struct IrradianceParts {
  Rgb direct = Rgb::Zero();  // from emittance [W/m^2]
  // The gradient by the position of the point, with a fixed normal. Edges through the point add nothing to
  // it.
  IrradianceGradient gradient = IrradianceGradient::Zero();
  std::vector<PatchContribution>
      contributions;  // of the patches that light the point, in the order of AddSource()
};

// The fraction of a point's light that returns to the point by way of `source`: rho rho' F^2 for the channel
// where it is largest. rho is the reflectance of `patch`, on which the point lies, rho' the reflectance of
// `source`, and F = `factor` the form factor of the point to `source`.
double SentBack(const Scene& scene, PatchId patch, PatchId source, double factor);

// The error that the terms of one source may cause, relative to `light`, the source's light without blockers:
// (1 - returned)^2 tolerance * (a fifth of `known` / light), for the channel where it is smallest. `known` is
// the irradiance of the point. A dim source may err more, since a point has many sources, whose errors have
// different signs; in a slot, where the fraction `returned` of the light comes back (SentBack), errors add up.
double AggregateTolerance(double tolerance, double returned, const Rgb& light, const Rgb& known);

// Use it as a local variable: its buffers are leases of the thread that makes it (Scratch).
class Gathering {
 public:
  // Without a method in the options, sources are clipped as whole trees, which is fastest. A method computes
  // the form factor of every polygon that blockers cover in part. `parts` may be null. All arguments must
  // outlive the object.
  Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at,
            const PointIrradianceOptions& options, IrradianceParts* parts);
  ~Gathering();
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;

  // Adds the light of a patch, with those candidates as blockers that stand before it. `own`, the receiver's
  // patch, does not block.
  void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own);
  // AddSource() with all patches of the hierarchy as candidates. `screens` are some of the patches that may
  // hide large parts of the view.
  void AddSource(PatchId source, const PatchHierarchy& patches, std::span<const Screen> screens);

  // From now on, adds the form factor of each leaf of the set to factors[number of the leaf].
  void RecordFactors(std::span<double> factors) { factors_ = factors; }

  // From now on, adds the sources and their terms to the row. REQUIRES: AllowAggregates() has been called, and
  // the options name no method.
  void RecordRow(FactorRow& row) { row_ = &row; }

  // From now on, a subtree of a source may count as one polygon with one radiosity, for speed. Let L be the
  // unoccluded light of a source, S the light of all sources before it or `known`, the approximate irradiance
  // of the point, if that is larger; c < 1 a constant, and T = (1 - r)^2 tolerance, where r is the largest
  // SentBack() of the sources up to this one. The aggregates of the source may cause an error of about
  // T max(L, c S), or T c S if the point is `mostly_hidden` from the light; add bright sources first.
  // REQUIRES: the point lies on a patch.
  void AllowAggregates(double tolerance, const Rgb& known = Rgb::Zero(), bool mostly_hidden = false);
  // The irradiance from the sources so far as if their blockers hid nothing; sources that are hidden
  // completely do not count [W/m^2]. REQUIRES: AllowAggregates().
  const Rgb& unhindered() const { return unhindered_; }
  // True if `light`, at most the light of all remaining sources, may be left out: in every channel it is at
  // most a quarter of T S, in the terms of AllowAggregates().
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
  // Of the current source, if tolerance_ > 0: the tolerance for its light, its normal, and the form factor of
  // all of its polygon above the horizon.
  double tolerance_here_ = 0;
  Vec3 source_normal_ = Vec3::Zero();
  double whole_ = 0;
  double factor_ = 0;  // of the current source, so far
  Rgb irradiance_ = Rgb::Zero();
  std::span<double> factors_;  // for each leaf of the set; empty: not recorded
  FactorRow* row_ = nullptr;   // null: not recorded
};

}  // namespace penumbra
