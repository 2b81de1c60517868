// solver/visibility/point/point_view.h
//
// The scene as one receiver point sees it: sources one after the other, and the blockers before them. What is
// seen of a blocker is computed once a point, whatever the number of sources behind it.

#pragma once

#include <span>
#include <vector>

#include "solver/base/scratch.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A local variable: its buffers are a lease of the thread that makes it (Scratch). All arguments must outlive
// it.
class PointView {
 public:
  // Sources are seen as if lifted by `source_push_off` along the receiver's normal [m] (thesis 6.4).
  PointView(const Scene& scene, const ReceiverPoint& at, const OcclusionMethod& method = FastestExactMethod(),
            double source_push_off = 0);
  ~PointView();
  PointView(const PointView&) = delete;
  PointView& operator=(const PointView&) = delete;

  const ReceiverPoint& at() const { return at_; }
  // The source that the view is turned to.
  const Patch& Source() const { return *source_; }

  // From where sources are seen: the point, unless they are lifted.
  const Vec3& SourceEye() const { return source_at_.position; }

  // Turns to a source. False if none of its front is above the receiver's horizon and to be seen from the
  // point.
  bool FaceSource(PatchId source);

  // What is seen, above the horizon, of a convex part of the source that the view is turned to.
  DirectionPolygon SeeSource(std::span<const Vec3> part) const;

  // Whether the source at hand lies above the horizon as a whole and does not touch the point, so that its
  // parts are seen as they are.
  bool SourceIsPlain() const { return !source_in_contact_ && !source_crosses_horizon_; }

  // Whether the point lies in the source's plane: what is seen of it is a limit.
  bool SourceInContact() const { return source_in_contact_; }

  // Appends those candidates that may hide parts of `seen`, before the plane of the source at hand; `own`,
  // the receiver's patch, is left out. Where the outline of a solid tells what it hides, it is appended once
  // for all its sides. False if one occluder hides all of `seen`: then nothing is appended. Their cones live
  // until the view turns to another source.
  bool FindBlockers(std::span<const PatchId> candidates, PatchId own, const DirectionPolygon& seen,
                    std::vector<Occluder>& occluders);

  // The form factor of the point to what the occluders leave of `seen`, by the method of the view.
  double VisibleFormFactor(const DirectionPolygon& seen, std::span<const Occluder> occluders) const;

  // Whether the approach direction of the point has decided anything so far.
  bool one_sided() const { return one_sided_; }

  // A buffer for occluders, empty at construction.
  std::vector<Occluder>& occluder_stack();

 private:
  struct BlockerView {
    bool in_limit = false;
    bool entered = false;  // of a solid: SolidOutline::entered
    Cone cone;             // size 0: it blocks nothing
  };
  struct Buffers;

  BlockerView ViewBlocker(std::span<const Vec3> polygon, const Patch& patch) const;
  BlockerView ViewSolid(const ConvexSolid& solid, const Patch* before) const;
  const BlockerView* FindBlocker(PatchId blocker, const DirectionPolygon& seen);
  bool FindSolid(SolidId id, const DirectionPolygon& seen, const BlockerView** view);

  const Scene& scene_;
  const ReceiverPoint& at_;
  ReceiverPoint source_at_;
  const OcclusionMethod& method_;
  Scratch<Buffers> buffers_;
  const Patch* source_ = nullptr;
  SolidId source_solid_ = kNoSolid;
  bool source_in_contact_ = false;
  bool source_crosses_horizon_ = false;
  bool one_sided_ = false;
};

}  // namespace penumbra
