// mesh/discontinuities/discontinuity.h
//
// Discontinuities: the lines on a patch where the irradiance is not smooth (thesis, chapter 5).
// Discontinuities are the intersections of a patch with critical surfaces, across which the visible part of a
// light source changes its topology.
//
// In comments on discontinuities, R is the receiver, S the source, b a point of a blocker, x the point where
// the line from S through b meets R's plane, and h the height above R's plane. Each Discontinuity is a
// straight segment. The thesis omits triple-edge discontinuities (EEE, thesis 5.2).
// DiscontinuityOptions::triple_edge_tolerance adds the triple-edge discontinuities as polylines.

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

// A line of kind kNear is no discontinuity in the strict sense, but a line near which the irradiance varies
// quickly. Below the edge of a source that hangs closely above the receiver, the irradiance falls steeply,
// over a distance of a few times the edge's height above the receiver. If the triangles of the mesh are wider
// than the strip below a hanging edge in which the irradiance falls steeply, the mesh needs edges along this
// strip.
enum class DiscontinuityKind : std::uint8_t { kVE, kEV, kHorizon, kContact, kEEE, kNear };

// The order of the lowest derivative of the irradiance that jumps across a discontinuity. At generic VE
// (vertex-edge), EV (edge-vertex) and EEE (three-edge) events, the second derivative of the irradiance jumps
// (D2). At the horizon of a source (where the source's plane meets the receiver), the first derivative of the
// irradiance jumps (D1). The first derivative of the irradiance also jumps if the source edge and the blocker
// edge of an event lie in one plane. At a contact with another surface, the irradiance itself jumps (D0).
enum class DiscontinuityDegree : std::uint8_t { kD0, kD1, kD2 };

// The change of the irradiance across a discontinuity, along the normal of its line in the receiver, for a
// source of 1 W/m^2. `gradient` and `curvature` are the jumps of the irradiance's first and second
// derivatives. `largest_gradient` bounds the change of the irradiance's gradient, and `largest_value` the
// change of the irradiance, at any distance from the discontinuity. Both bounds follow from the size of the
// source, because a blocker hides at most the whole source.
struct IrradianceJump {
  // The jump of the irradiance's first derivative across a D1 discontinuity, for a source of 1 W/m^2 [1/m].
  double gradient = 0;
  // The jump of the irradiance's second derivative across a D2 discontinuity, for a source of 1 W/m^2;
  // infinite for a D1 discontinuity [1/m^2].
  double curvature = 0;
  // An upper bound of the change of the irradiance's first derivative, for a source of 1 W/m^2 [1/m].
  double largest_gradient = 0;
  // An upper bound of (change of the irradiance across the discontinuity) / (radiosity of the source) [1].
  double largest_value = 0;
};

// A discontinuity is a segment of nonzero length on the receiver (thesis 5.5.3).
struct Discontinuity {
  // End points of the segment in the receiver's PolygonFrame() [m].
  std::array<Vec2, 2> end = {Vec2::Zero(), Vec2::Zero()};
  DiscontinuityKind kind = DiscontinuityKind::kVE;
  DiscontinuityDegree degree = DiscontinuityDegree::kD2;
  PatchId receiver = kNoPatch;
  PatchId source = kNoPatch;  // the patch that sends the light; kNoPatch for a contact with another surface
  // The patch that blocks the light; kNoPatch for the horizon of a source and for a line of kind kNear. For a
  // contact, the blocker is the patch that touches the receiver.
  PatchId blocker = kNoPatch;
  // source_part and blocker_part are the numbers of the source's and the blocker's vertices or edges that
  // cause the event. For a VE event, source_part is a vertex of the source, and blocker_part an edge of the
  // blocker. For an EV event, source_part is an edge of the source, and blocker_part a vertex of the blocker.
  // For an EEE event, source_part and blocker_part are edges; source_part is -1 if all three edges belong to
  // blockers. For kind kNear (a line close below an edge of a source), source_part is the number of the
  // source's edge. The number of an edge of a patch is the number of the vertex where the edge starts.
  std::int32_t source_part = -1, blocker_part = -1;
  // The second and third blocker edges of an EEE (three-edge) event. A three-edge event has a third blocker
  // edge only if no edge of the event belongs to the source.
  PatchEdge second_blocker_edge, third_blocker_edge;
  // If a source edge and a blocker edge lie in one plane, so that the first derivative of the irradiance
  // jumps (D1), shared_source_edge and shared_blocker_edge hold the two edges.
  std::int32_t shared_source_edge = -1;
  PatchEdge shared_blocker_edge;
  // The geometric weight is the ratio d_sb / d_sr <= 1 of the distances source-blocker and source-receiver,
  // at the point of the segment where this ratio is largest. The geometric weight of the horizon of a source
  // is 1, and that of a contact is infinite.
  double geometric_weight = 0;
  static constexpr int kJumps = 3;
  // The jumps of the irradiance's derivatives at three points of the segment.
  std::array<IrradianceJump, kJumps> jump;
  double strength = 0;  // largest radiosity anywhere on the source [W/m^2]
  double weight = 0;    // result of Weight() for the discontinuity on the whole receiver [W/m^2]
  // True if mesh refinement has requested a mesh edge along this discontinuity, even if `weight` is small.
  bool wanted = false;
};

// True if `a` and `b` are the same segment of the receiver, with the same source and of the same kind, even
// if separate calls found `a` and `b`.
inline bool SameTrace(const Discontinuity& a, const Discontinuity& b) {
  return a.source == b.source && a.kind == b.kind && a.end[0] == b.end[0] && a.end[1] == b.end[1];
}

inline constexpr double kInfiniteWeight = std::numeric_limits<double>::infinity();

// Returns the weight [W/m^2] of the discontinuity on a piece of the mesh, such as a quadtree leaf. `size` [m]
// is the extent of the piece of the mesh perpendicular to the discontinuity. `margin` [m] is the smallest
// distance between the discontinuity and the borders of this piece of the mesh.
//  kThesis: the weight is geometric_weight * strength (thesis 5.3), independent of the piece of the mesh.
//  kIrradiance: the weight is strength * min(largest_value, KinkError() * max(|gradient|, largest_gradient),
//   BendError() * |curvature|), with the members of IrradianceJump. The weight kIrradiance estimates the
//   error of the quadratic through the nodes of a piece of the mesh if no edge follows the discontinuity.
//  With both kinds of weight, the weight of a contact with another surface is kInfiniteWeight.
double Weight(const Discontinuity& d, DiscontinuityWeight kind, double size,
              double margin = std::numeric_limits<double>::infinity());

// kKinkError and kBendError are the maximum of |f(x) - q(x)| over x and c in [0, 1], where q is the quadratic
// that interpolates f at 0, 1/2 and 1. For kKinkError, the interpolated function is f(x) = max(0, x - c). For
// kBendError, the interpolated function is f(x) = max(0, x - c)^2 / 2.
inline constexpr double kKinkError = 0.0962;
inline constexpr double kBendError = 0.0188;
// For KinkError() and BendError(), a quadratic interpolates a function on an interval of length `size` [m],
// and the function has a kink or bend at c, at least `margin` [m] from the ends. KinkError() bounds the
// quadratic's error for the function max(0, x - c) by min(kKinkError * size, margin) [m]. BendError() bounds
// the quadratic's error for the function max(0, x - c)^2 / 2 by min(kBendError * size^2, margin^2 / 2) [m^2].
double KinkError(double size, double margin);
double BendError(double size, double margin);

// A DiscontinuityFinder finds the discontinuities of one receiver per call. The constructor of
// DiscontinuityFinder finds which patches share edges.
class DiscontinuityFinder {
 public:
  // Scene and visibility must outlive the DiscontinuityFinder.
  DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility);
  ~DiscontinuityFinder();
  DiscontinuityFinder(DiscontinuityFinder&&) noexcept;

  // Find() returns all contacts (lines where surfaces touch the receiver), and all other discontinuities
  // whose weight on the whole receiver is at least options.min_weight. `source_strength` [W/m^2] holds for
  // each patch the largest radiosity over the patch's quadtree leaves and the channels.
  //  (1) Every discontinuity lies on the receiver and is longer than SnapDistance(), the distance within
  //   which points of a patch count as one point.
  //  (2) The same input gives the same list of discontinuities, in the same order. Equal segments may occur
  //   several times in the list of discontinuities.
  //  (3) An edge that two patches share causes a VE (vertex-edge) event only if the edge is a silhouette: the
  //   source's vertex sees the front of exactly one of the two patches. The VE event of an edge that two
  //   patches share occurs once in the list, not once per patch. A corner of a blocker causes an EV
  //   (edge-vertex) event only if at least two edges at the corner are silhouettes, and these edges do not
  //   lie in one line.
  //  (4) Unless options.keep_hidden is set, the list omits the hidden parts of discontinuities. A part of a
  //   discontinuity is hidden if another blocker cuts the lines of sight from this part through the vertex
  //   and the edge of the event to the source.
  //  (5) Edges and vertices of blockers within ContactGap() of the receiver count as touching the receiver.
  //   Edges and vertices that touch the receiver cause contacts, but no other discontinuities.
  //  (6) If options.triple_edge_tolerance > 0, the list includes the polylines of EEE (three-edge) events.
  //  (7) The list includes lines of kind kNear (where the irradiance falls steeply) for each source edge
  //   whose height above the receiver is at most kMaxHangingHeight * (length of the edge). Lines of kind
  //   kNear are parallel to the edge of the source, at increasing distances from the edge.
  // Find() may be called from several threads at once. If the computation is cancelled, the list of
  // discontinuities is incomplete.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext()) const;

  // FindContacts() and FindFrom() together compute the result of Find(), which returns all discontinuities of
  // a receiver. FindContacts() returns the contacts on the receiver, the lines where other surfaces touch the
  // receiver. FindFrom() returns the discontinuities that one source causes on the receiver; the source is an
  // element of PatchVisibility::SourcesOf(receiver). `strength` is the largest radiosity of the source
  // [W/m^2]. FindFrom() returns an empty list if Counts(strength, options) is false. If the computation is
  // cancelled, the list of discontinuities is incomplete.
  std::vector<Discontinuity> FindContacts(PatchId receiver, const DiscontinuityOptions& options) const;
  std::vector<Discontinuity> FindFrom(PatchId receiver, const PatchPair& pair, double strength,
                                      const DiscontinuityOptions& options,
                                      const ExecutionContext& context = ExecutionContext()) const;
  // True if a source of radiosity `strength` can cause a discontinuity whose weight is at least
  // options.min_weight. No weight of a discontinuity exceeds `strength`, because geometric weights and form
  // factors are at most 1.
  static bool Counts(double strength, const DiscontinuityOptions& options) {
    return strength > 0 && strength >= options.min_weight;
  }

  // Returns the jumps of the irradiance's derivatives (JumpAt) across a discontinuity of this scene. The
  // point `at` lies on the line of the discontinuity, and is given in the receiver's frame [m].
  IrradianceJump Jump(const Discontinuity& d, const Vec2& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
