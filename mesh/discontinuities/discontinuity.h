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
// receiver, the irradiance falls within a few times the edge's height. Where the triangles of the mesh are
// larger than a few times the edge's height, the mesh must follow the edge like a discontinuity.
enum class DiscontinuityKind : std::uint8_t { kVE, kEV, kHorizon, kContact, kEEE, kNear };

// The lowest derivative of the irradiance that jumps. Generic VE, EV and EEE events are D2. A horizon is D1,
// and so is an event whose source edge and blocker edge lie in one plane. A contact is D0.
enum class DiscontinuityDegree : std::uint8_t { kD0, kD1, kD2 };

// The change of the irradiance across a discontinuity, along the normal of its line in the receiver, for a
// source of 1 W/m^2. `gradient` and `curvature` are jumps of derivatives. `largest_gradient` and
// `largest_value` are upper bounds of the total changes of gradient and irradiance that the event causes; the
// changes are bounded because the effect of the event ends at some distance from the discontinuity.
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
  // source_part and blocker_part are the numbers of the vertices or edges that cause the event. For VE,
  // source_part is a vertex of the source, and blocker_part an edge of the blocker. For EV, source_part is an
  // edge, and blocker_part a vertex. For EEE, source_part and blocker_part are edges; source_part is -1 if no
  // edge belongs to the source. For kNear, source_part is the edge of the source. An edge is numbered by the
  // vertex where it starts.
  std::int32_t source_part = -1, blocker_part = -1;
  PatchEdge second_blocker_edge, third_blocker_edge;  // EEE; the third if no edge is the source's
  // For D1 events, the edge of the source and the edge of the blocker that lie in one plane.
  std::int32_t shared_source_edge = -1;
  PatchEdge shared_blocker_edge;
  double geometric_weight = 0;  // max(d_sb / d_sr), at most 1; 1 for a horizon, infinite for a contact
  static constexpr int kJumps = 3;
  std::array<IrradianceJump, kJumps> jump;  // at points spread along the segment
  double strength = 0;                      // the source's largest radiosity [W/m^2]
  double weight = 0;                        // on the whole receiver [W/m^2], see Weight()
  bool wanted = false;                      // refinement has requested it, whatever its weight
};

// True if `a` and `b` are the same trace of the same critical surface, even if they were found by separate
// calls.
inline bool SameTrace(const Discontinuity& a, const Discontinuity& b) {
  return a.source == b.source && a.kind == b.kind && a.end[0] == b.end[0] && a.end[1] == b.end[1];
}

inline constexpr double kInfiniteWeight = std::numeric_limits<double>::infinity();

// The weight [W/m^2] of the discontinuity on a piece of the mesh. `size` [m] is the extent of the piece
// across the discontinuity; `margin` [m] is the smallest distance between the discontinuity and the piece's
// borders.
//  kThesis: geometric_weight * strength (thesis 5.3), independent of the piece.
//  kIrradiance: strength * min(largest_value, KinkError() * max(|gradient|, largest_gradient), BendError() *
//   |curvature|), with the members of the IrradianceJump: an estimate of the error of the quadratic through
//   the piece's nodes if the piece has no edge along the discontinuity.
//  With both kinds, the weight of a contact is kInfiniteWeight.
double Weight(const Discontinuity& d, DiscontinuityWeight kind, double size,
              double margin = std::numeric_limits<double>::infinity());

// The maximum over x and c in [0, 1] of |f(x) - q(x)|, where q is the quadratic that interpolates f at 0, 1/2
// and 1. f(x) = max(0, x - c) for kKinkError, and f(x) = max(0, x - c)^2 / 2 for kBendError.
inline constexpr double kKinkError = 0.0962;
inline constexpr double kBendError = 0.0188;
// Let a quadratic interpolate a function on an interval of length `size` [m], in which c is at least `margin`
// [m] from the ends. KinkError() bounds the error for max(0, x - c) by min(kKinkError * size, margin) [m].
// BendError() bounds the error for max(0, x - c)^2 / 2 by min(kBendError * size^2, margin^2 / 2) [m^2].
double KinkError(double size, double margin);
double BendError(double size, double margin);

// Finds the discontinuities of one receiver per call. The constructor finds the patches that share edges.
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
  //   corner causes an EV event only if at least two edges at the corner are silhouettes, and these edges do
  //   not lie in one line.
  //  (4) Unless options.keep_hidden is set, the list omits hidden parts of segments: at these parts, another
  //   blocker of the pair intersects the lines from the receiver through vertex and edge.
  //  (5) Edges and vertices of blockers within ContactGap() of the receiver count as touching the receiver.
  //   Edges and vertices that touch the receiver cause contacts, but no further discontinuities.
  //  (6) If options.triple_edge_tolerance > 0, the list includes the pieces of EEE events.
  //  (7) For an edge of a source whose height above the receiver is at most kMaxHangingHeight times the
  //   edge's length, the list includes lines of kind kNear along the edge, at increasing distances from the
  //   edge.
  // May be called from several threads at once. If the context is cancelled, the result is incomplete.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext()) const;

  // Two functions that compute the result of Find() in parts. FindContacts() returns the contacts. FindFrom()
  // returns the discontinuities that one source causes; the source is an element of
  // PatchVisibility::SourcesOf(receiver). `strength` is the largest radiosity of the source [W/m^2]; unless
  // Counts(strength), the list is empty. If the context is cancelled, the result is incomplete.
  std::vector<Discontinuity> FindContacts(PatchId receiver, const DiscontinuityOptions& options) const;
  std::vector<Discontinuity> FindFrom(PatchId receiver, const PatchPair& pair, double strength,
                                      const DiscontinuityOptions& options,
                                      const ExecutionContext& context = ExecutionContext()) const;
  // True if a source of this strength can cause a discontinuity of the minimum weight: the geometric weight
  // and the form factor of a source are at most 1.
  static bool Counts(double strength, const DiscontinuityOptions& options) {
    return strength > 0 && strength >= options.min_weight;
  }

  // The result of JumpAt() for a discontinuity of this scene at `at`, a point of its line in the receiver's
  // frame [m].
  IrradianceJump Jump(const Discontinuity& d, const Vec2& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
