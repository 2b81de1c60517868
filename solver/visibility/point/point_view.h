// solver/visibility/point/point_view.h
//
// The scene as seen from one receiver point: the sources, one after another, and the blockers in front of
// each source. The view of a blocker is computed only once for each receiver point, even if the blocker hides
// parts of many sources.

#pragma once

#include <span>
#include <vector>

#include "solver/base/scratch.h"
#include "solver/scene/scene.h"
#include "solver/visibility/point/direction_polygon.h"
#include "solver/visibility/point/occlusion_method.h"
#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// A PointView must be a local variable, because it borrows its buffers from the thread that creates it
// (Scratch). The arguments of the constructor must outlive the PointView.
class PointView {
 public:
  // Sources are treated as if they were moved by `source_push_off` * (the receiver's normal) [m] (thesis
  // 6.4).
  PointView(const Scene& scene, const ReceiverPoint& at, const OcclusionMethod& method = FastestExactMethod(),
            double source_push_off = 0);
  ~PointView();
  PointView(const PointView&) = delete;
  PointView& operator=(const PointView&) = delete;

  const ReceiverPoint& at() const { return at_; }
  // The current source, which the last call of FaceSource() has set.
  const Patch& Source() const { return *source_; }

  // The viewpoint from which sources are seen: the receiver point, moved by -source_push_off * normal.
  const Vec3& SourceEye() const { return source_at_.position; }

  // Makes `source` the current source. Returns false if no part of the source's front lies above the
  // receiver's horizon and faces the receiver point.
  bool FaceSource(PatchId source);

  // The directions of a convex part of the current source as seen from the point, clipped to the horizon.
  DirectionPolygon SeeSource(std::span<const Vec3> part) const;

  // True if the whole current source lies above the horizon and the plane of the source does not contain the
  // receiver point. The view of a source for which SourceIsPlain() is true needs neither clipping to the
  // horizon nor a one-sided limit.
  bool SourceIsPlain() const { return !source_in_contact_ && !source_crosses_horizon_; }

  // True if the plane of the current source contains the receiver point, so that the view of the source is a
  // one-sided limit.
  bool SourceInContact() const { return source_in_contact_; }

  // Appends to `occluders` the candidates that may hide parts of `seen`, the view of a part of the current
  // source. Each candidate is clipped to the front side of the current source's plane. `own`, the receiver's
  // patch, does not block light. If the outline of a convex solid bounds exactly the region that the solid
  // hides, a single occluder represents all sides of the solid. Returns false and appends nothing if one
  // occluder hides all of `seen`. The cones of the occluders are valid until the next call of FaceSource().
  bool FindBlockers(std::span<const PatchId> candidates, PatchId own, const DirectionPolygon& seen,
                    std::vector<Occluder>& occluders);

  // The form factor of the point to the part of `seen` that no occluder covers, computed by the occlusion
  // method passed to the constructor.
  double VisibleFormFactor(const DirectionPolygon& seen, std::span<const Occluder> occluders) const;

  // True if any result since the construction of the PointView was a one-sided limit, which depends on
  // ReceiverPoint::approach.
  bool one_sided() const { return one_sided_; }

  // A buffer for lists of occluders, for use by the caller; it is empty when the PointView is constructed.
  std::vector<Occluder>& occluder_stack();

 private:
  struct BlockerView {
    bool in_limit = false;
    // For a solid: true if light can enter it through a missing side (SolidOutline::entered).
    bool entered = false;
    Cone cone;  // the cone of directions that the blocker hides; its size is 0 if the blocker hides nothing
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
