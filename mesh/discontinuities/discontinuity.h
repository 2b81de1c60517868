// mesh/discontinuities/discontinuity.h
//
// Discontinuities: the places on a patch where the irradiance is not smooth (thesis, chapter 5).
// Discontinuities are the traces, on the patch, of the critical surfaces of sources and blockers.
//
// Notation: R is the receiver, S the source, b a point of a blocker, x the point where the line from S
// through b meets R's plane, and h the height above R's plane. Discontinuities are straight segments. The
// thesis omits triple-edge (EEE) events (5.2); options.triple_edge_tolerance adds them as polylines.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/discontinuities/silhouettes.h"
#include "solver/base/progress.h"
#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// kNear is no discontinuity in the strict sense: below the edge of a source that hangs closely above the
// receiver, the irradiance falls within a few times the edge's height. A mesh of larger triangles must follow
// the edge as it follows discontinuities.
enum class DiscontinuityKind : std::uint8_t { kVE, kEV, kHorizon, kContact, kEEE, kNear };

// The lowest derivative of the irradiance that jumps. Generic VE, EV and EEE events are D2. A horizon is D1,
// and so is an event whose source edge and blocker edge lie in one plane. A contact is D0.
enum class DiscontinuityDegree : std::uint8_t { kD0, kD1, kD2 };

// The change of the irradiance across a discontinuity, along the normal of its line in the receiver, for a
// source of 1 W/m^2. `gradient` and `curvature` are jumps of derivatives. `largest_gradient` and
// `largest_value` bound the changes that the jumps cause on a receiver so large that the event ends on it.
struct IrradianceJump {
  double gradient = 0;          // jump of the first derivative, of D1 events [1/m]
  double curvature = 0;         // jump of the second derivative, of D2 events; infinite for D1 [1/m^2]
  double largest_gradient = 0;  // [1/m]
  double largest_value = 0;     // [1]
};

// A segment of nonzero length on the receiver (thesis 5.5.3).
struct Discontinuity {
  std::array<Vec2, 2> end = {Vec2::Zero(), Vec2::Zero()};  // in the frame PolygonFrame() of the receiver [m]
  DiscontinuityKind kind = DiscontinuityKind::kVE;
  DiscontinuityDegree degree = DiscontinuityDegree::kD2;
  PatchId receiver = kNoPatch;
  PatchId source = kNoPatch;   // kNoPatch for a contact
  PatchId blocker = kNoPatch;  // kNoPatch for a horizon and a near edge; the touching patch for a contact
  // VE: the vertex of the source and the edge of the blocker that span the plane of the event. EV: the
  // source's edge and the blocker's vertex. Near: the source's edge. EEE: the source's edge, or -1 if the
  // source has none, and the blocker's edge. The number of an edge is the number of the vertex where the
  // edge starts.
  std::int32_t source_part = -1, blocker_part = -1;
  PatchEdge second_blocker_edge, third_blocker_edge;  // EEE; the third if no edge is the source's
  // D1 events: the edges of source and blocker that lie in one plane.
  std::int32_t shared_source_edge = -1;
  PatchEdge shared_blocker_edge;
  double geometric_weight = 0;  // max(d_sb / d_sr), at most 1; 1 for a horizon, infinite for a contact
  static constexpr int kJumps = 3;
  std::array<IrradianceJump, kJumps> jump;  // at points spread along the segment
  double strength = 0;                      // the source's largest radiosity [W/m^2]
  double weight = 0;                        // on the whole receiver [W/m^2], see Weight()
  bool wanted = false;                      // refinement has requested it, whatever its weight
};

// True if both are the same trace of the same critical surface, even if separate searches found them.
inline bool SameTrace(const Discontinuity& a, const Discontinuity& b) {
  return a.source == b.source && a.kind == b.kind && a.end[0] == b.end[0] && a.end[1] == b.end[1];
}

inline constexpr double kInfiniteWeight = std::numeric_limits<double>::infinity();

// The weight [W/m^2] of the discontinuity on a piece of the mesh. `size` [m] is the extent of the piece
// across the discontinuity; `margin` [m] is the smallest distance between the discontinuity and the piece's
// borders.
//  kThesis: geometric_weight * strength (thesis 5.3), for any piece.
//  kIrradiance: an estimate of the largest error of the quadratic through the piece's nodes if the piece has
//   no edge along the discontinuity: the least of largest_value, KinkError() * (jump of the gradient or
//   largest_gradient) and BendError() * (jump of the second derivative), times `strength`.
//  A contact weighs kInfiniteWeight.
double Weight(const Discontinuity& d, DiscontinuityWeight kind, double size,
              double margin = std::numeric_limits<double>::infinity());

// The largest error, over x in [0, 1] and over c, of the quadratic through the values at 0, 1/2 and 1 of
// max(0, x - c), and of max(0, x - c)^2 / 2. For a step, the largest error is the step's height.
inline constexpr double kKinkError = 0.0962;
inline constexpr double kBendError = 0.0188;
// The largest errors of the same two functions on a piece of extent `size` [m] whose borders are at least
// `margin` [m] from c: min(kKinkError size, margin) [m] and min(kBendError size^2, margin^2 / 2) [m^2].
double KinkError(double size, double margin);
double BendError(double size, double margin);

// Finds the discontinuities of one receiver per call. The constructor lists the patches that share an edge.
class DiscontinuityFinder {
 public:
  // Scene and visibility must outlive the finder.
  DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility);
  ~DiscontinuityFinder();
  DiscontinuityFinder(DiscontinuityFinder&&) noexcept;

  // Returns all contacts on the receiver, and its other discontinuities whose weight on the whole receiver is
  // at least options.min_weight. `source_strength` [W/m^2] holds for each patch the largest radiosity over
  // the patch's leaves and the channels.
  //  (1) Every segment lies on the receiver and is longer than SnapDistance().
  //  (2) The same input gives the same list, in the same order. Equal segments may occur several times.
  //  (3) An edge that two patches share causes a VE event only if the edge is a silhouette: not if both
  //   patches face the source's vertex, or both face away. The event occurs once, not once per patch. A
  //   corner causes an EV event only if at least two edges there are silhouettes and these do not lie in one
  //   line.
  //  (4) Unless options.keep_hidden is set, the list omits the parts of a segment where another blocker of
  //   the pair meets the lines from the receiver through vertex and edge.
  //  (5) Edges and vertices of blockers within ContactGap() of the receiver touch the receiver. Such edges
  //   and vertices cause contacts, but no further discontinuities.
  //  (6) If options.triple_edge_tolerance > 0, the list includes the pieces of EEE events.
  //  (7) For an edge of a source whose height above the receiver is at most kMaxHangingHeight times the
  //   edge's length, the list includes near lines along the edge, at growing distances.
  // Safe from any thread. If the context is cancelled, the result is incomplete.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext()) const;

  // The parts of Find()'s result: FindContacts() returns the contacts; FindFrom() the discontinuities that
  // one of SourcesOf() the receiver causes, none unless Counts(strength). `strength` is in W/m^2. If the
  // context is cancelled, the result is incomplete.
  std::vector<Discontinuity> FindContacts(PatchId receiver, const DiscontinuityOptions& options) const;
  std::vector<Discontinuity> FindFrom(PatchId receiver, const PatchPair& pair, double strength,
                                      const DiscontinuityOptions& options,
                                      const ExecutionContext& context = ExecutionContext()) const;
  // True if a source of this strength can cause a discontinuity of the minimum weight: the geometric weight
  // and the form factor of a source are at most 1.
  static bool Counts(double strength, const DiscontinuityOptions& options) {
    return strength > 0 && strength >= options.min_weight;
  }

  // JumpAt() across the line of a discontinuity of this scene, at the point `at` of the line, in the
  // receiver's frame.
  IrradianceJump Jump(const Discontinuity& d, const Vec2& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
