// solver/transport/points/gathering.h
//
// What one receiver point gathers from the sources of a SourceSet, one patch after the other.

#pragma once

#include <span>
#include <vector>

#include "solver/base/scratch.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/point/clipping.h"
#include "solver/visibility/point/point_view.h"

namespace penumbra {

struct PointIrradianceOptions {
  // What decides which part of a source blockers leave. Null: the fastest exact way.
  const OcclusionMethod* method = nullptr;
  // The thesis's substitutes for limits (6.3, 6.4, Appendix A), to compare with. A point that asks for a
  // limit is moved this far along its approach [m]; sources are lifted this far along the receiver's normal
  // [m].
  double nudge = 0;
  double source_push_off = 0;
  // Where there is no method and this is positive: backprojection, which collapses segments of blockers'
  // outlines that are shorter than this, relative to the source's diameter as seen.
  double min_backprojection_segment = 0;
  // The part of their tolerance to which samples for interpolants keep (PointIrradiance::NearlyOnPatch): what
  // is left out comes back with every bounce, and in rooms that are nearly white there are many.
  double part_of_tolerance = 1;
};

// The light that a point receives from one patch.
struct PatchContribution {
  PatchId source = kNoPatch;
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
};

// One row a channel: its derivatives by x, y and z [W/m^3].
using IrradianceGradient = Eigen::Matrix3d;

// What irradiance at a point is made of.
struct IrradianceParts {
  Rgb direct = Rgb::Zero();  // from what surfaces emit of themselves [W/m^2]
  // By the position of the point, its normal fixed. Edges through the point have no share in it.
  IrradianceGradient gradient = IrradianceGradient::Zero();
  std::vector<PatchContribution>
      contributions;  // of the patches that light the point, in the order asked for
};

// What share of a point's light comes back to it by way of a source that it sees with this form factor:
// rho rho' F^2, the channel where it is most.
double SentBack(const Scene& scene, PatchId patch, PatchId source, double factor);

// A local variable: its buffers are leases of the thread that makes it (Scratch).
class Gathering {
 public:
  // Without a method, sources are clipped as whole trees, which is fastest; with one, it is asked about every
  // polygon that blockers cover in part. `parts` may be null. All arguments must outlive the object.
  Gathering(const Scene& scene, const SourceSet& sources, const ReceiverPoint& at,
            const PointIrradianceOptions& options, IrradianceParts* parts);
  ~Gathering();
  Gathering(const Gathering&) = delete;
  Gathering& operator=(const Gathering&) = delete;

  // Adds the light of a patch past those of the candidates that stand before it; `own`, the receiver's patch,
  // does not block.
  void AddSource(PatchId source, std::span<const PatchId> candidates, PatchId own);
  // The same past whatever of the hierarchy stands before it. Some of what may hide much is known as screens.
  void AddSource(PatchId source, const PatchHierarchy& patches, std::span<const Screen> screens);

  // Adds the form factors of the set's leaves to these, by their number.
  void RecordFactors(std::span<double> factors) { factors_ = factors; }

  // From here on parts of trees may be seen as one of their mean radiosity where that costs at most about
  // this share of the light that they send, or a part of that share of all light of the sources before. So
  // the brightest should come first. If what the point receives is known, about, the light beside which all
  // of this counts is a part of that. From the source on that sends back the most, (1 - r)^2 of the share
  // holds, r = rho rho' F^2 as in PointIrradiance::Reverberation(). REQUIRES: the point lies on a patch.
  void AllowAggregates(double tolerance, const Rgb& known = Rgb::Zero());
  // What the sources so far would have brought without what hides them in part.
  const Rgb& unhindered() const { return unhindered_; }
  // Whether light beside that of the sources before is less than a small part of that share.
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
  void GatherShadowed(Tree tree, std::size_t i);
  ImagePolygon ImageOf(const SourceSet::Node& node, const ImageFrame& frame) const;
  void GatherNode(Tree tree, std::size_t i, const ImageFrame& frame, const Clipper::Candidates& candidates);
  void GatherVisible(Tree nodes);
  void GatherAggregates(Tree nodes);
  double Tolerance() const;
  double ToleranceFor(const Rgb& light) const;
  bool MayAggregate(const SourceSet::Node& node, bool visible) const;
  void AddMoment(const SourceSet::Node& node);
  void AddListedSources();
  void GatherUnfit(const SourceSet::Node& leaf, const DirectionPolygon& seen);
  void AddVisiblePieces(const ImageFrame& frame, double visible_before);
  double CancellationAllowed() const;
  void AddGradientOfPieces(const ImageFrame& frame);
  void Add(std::int32_t leaf, double factor);
  void Add(const Rgb& radiosity, double factor);
  Rgb RadiosityToward(const SourceSet::Node& node, const Vec3& direction) const;
  void AddGradient(std::int32_t leaf, const Vec3& gradient);

  const Scene& scene_;
  const SourceSet& sources_;
  const ReceiverPoint& at_;
  const OcclusionMethod* method_;
  IrradianceParts* parts_;
  PointView view_;
  std::vector<Occluder>& occluders_;  // of the source at hand
  Scratch<Buffers> buffers_;
  Clipper& clipper_;  // one of the buffers
  double tolerance_ = 0;
  Rgb known_ = Rgb::Zero();       // about what the point receives; zero: not known
  Rgb unhindered_ = Rgb::Zero();  // with a tolerance: what the sources so far would bring unhindered
  Rgb so_far_ = Rgb::Zero();      // with a tolerance: the light of the sources that are done, about
  double returned_ = 0;  // with a tolerance: the most of the point's light that a source sends back to it
  // Of the source at hand, with a tolerance: what holds for it, its normal, and the form factor of all that
  // is above the horizon.
  double tolerance_here_ = 0;
  Vec3 source_normal_ = Vec3::Zero();
  double whole_ = 0;
  double factor_ = 0;  // of the source at hand, so far
  Rgb irradiance_ = Rgb::Zero();
  std::span<double> factors_;  // per leaf of the set; empty: not asked for
};

}  // namespace penumbra
