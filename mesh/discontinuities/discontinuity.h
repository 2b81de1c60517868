// mesh/discontinuities/discontinuity.h
//
// Where the irradiance over a patch is not smooth (thesis, chapter 5): the traces of critical surfaces
// between sources, blockers and the patch.
//
// Notation: R receiver, S source, b a point of a blocker, x the point of R's plane on the line from S through
// b, h the height above R's plane. Everything lies on straight segments, or on polylines where triple-edge
// (EEE) surfaces are asked for, which the thesis leaves out (5.2).

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

// kNear is none in the strict sense: beside an edge of a source that hangs closely above the receiver the
// irradiance falls within a few times the height, and a mesh that is coarser has to follow it as it follows
// discontinuities.
enum class DiscontinuityKind : std::uint8_t { kVE, kEV, kHorizon, kContact, kEEE, kNear };

// The lowest derivative of the irradiance that jumps. Generic VE, EV and EEE events are D2, a horizon is D1
// (so is an event whose source edge and blocker edge share a plane), a contact D0.
enum class DiscontinuityDegree : std::uint8_t { kD0, kD1, kD2 };

// What happens to the irradiance across a discontinuity, along the normal of its line in the receiver, for a
// source of 1 W/m^2. Jumps are those of the derivatives; the largest changes bound what the jumps lead to on
// a receiver so large that the event itself ends on it.
struct IrradianceJump {
  double gradient = 0;          // of D1 events [1/m]
  double curvature = 0;         // of the second derivative, D2; infinite for D1 events [1/m^2]
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
  // VE: the source's vertex and the blocker's edge that meet; EV: the source's edge and the blocker's vertex;
  // near: the source's edge. EEE: the source's edge, or -1, and that of the blocker. An edge has the number
  // of the vertex where it starts.
  std::int32_t source_part = -1, blocker_part = -1;
  PatchEdge second_blocker_edge, third_blocker_edge;  // EEE; the third where there is no edge of the source
  // Of a D1 event: the edges that lie in one plane.
  std::int32_t shared_source_edge = -1;
  PatchEdge shared_blocker_edge;
  double geometric_weight = 0;  // max(d_sb / d_sr), at most 1; 1 for a horizon, infinite for a contact
  static constexpr int kJumps = 3;
  std::array<IrradianceJump, kJumps> jump;  // at points spread along the segment
  double strength = 0;                      // the source's largest radiosity [W/m^2]
  double weight = 0;                        // on the receiver as a whole [W/m^2]: see Weight()
  bool wanted = false;                      // by refinement, whatever it weighs
};

// True if both are the same trace of the same critical surface, as it was found at any time.
inline bool SameTrace(const Discontinuity& a, const Discontinuity& b) {
  return a.source == b.source && a.kind == b.kind && a.end[0] == b.end[0] && a.end[1] == b.end[1];
}

inline constexpr double kInfiniteWeight = std::numeric_limits<double>::infinity();

// What the discontinuity weighs on a piece of the mesh of the size [m], across it, and no nearer than
// `margin` [m] to the piece's borders.
//  kThesis: geometric_weight times strength (thesis 5.3), on any piece.
//  kIrradiance: an estimate of the largest error of the quadratic through the piece's nodes, if it has no
//  edge there: kKinkError x size x jump of the gradient, or kBendError x size^2 x jump of the second
//  derivative; beside a border what a straight line, or a parabola, that runs on to it is off by; at most
//  what the largest changes allow.
double Weight(const Discontinuity& d, DiscontinuityWeight kind, double size,
              double margin = std::numeric_limits<double>::infinity());

// The largest error over [0, 1] and over c of the quadratic through the values at 0, 1/2 and 1 of
// max(0, x - c), and of max(0, x - c)^2 / 2. For a step it is its height.
inline constexpr double kKinkError = 0.0962;
inline constexpr double kBendError = 0.0188;
// The same on a piece of the size, in which neither lies nearer than `margin` to a border [m, m^2].
double KinkError(double size, double margin);
double BendError(double size, double margin);

// Finds the discontinuities on one receiver at a time. Lists which patches share an edge once, at
// construction.
class DiscontinuityFinder {
 public:
  // Both must outlive the finder.
  DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility);
  ~DiscontinuityFinder();
  DiscontinuityFinder(DiscontinuityFinder&&) noexcept;

  // All contacts on the receiver, and its VE, EV and horizon discontinuities whose weight on the receiver as
  // a whole is at least options.min_weight. `source_strength` [W/m^2] holds for each patch the largest
  // radiosity (over its leaves and the channels).
  //  (1) Every segment lies on the receiver and is longer than SnapDistance().
  //  (2) The same input gives the same list, in the same order. Equal segments may occur several times.
  //  (3) A VE event of an edge that two patches share is left out where both face the source's vertex, or
  //  both look
  //      away: the edge is no silhouette. Its copy from the second patch is left out as well.
  //  Likewise an EV event of a corner at which fewer than two edges are silhouettes, or two in one line.
  //  (4) Unless options.keep_hidden, parts of a segment are left out where another patch of the pair's
  //  blockers stands in the lines from the receiver through vertex and edge.
  //  (5) What comes within ContactGap() of the receiver touches it, and casts no shadow line of its own
  //  beside the
  //      contact.
  //  (6) With options.triple_edge_tolerance also the pieces of EEE events.
  //  (7) Beside an edge of a source that hangs at most kMaxHangingHeight of its length above the receiver
  //  lines run along the edge, ever farther from it.
  // Safe from any thread. Of no use if it was cancelled.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  const DiscontinuityOptions& options,
                                  const ExecutionContext& context = ExecutionContext()) const;

  // The parts that Find() joins: the contacts, and what one of SourcesOf() the receiver casts, if its
  // strength [W/m^2] counts; of no use if it was cancelled.
  std::vector<Discontinuity> FindContacts(PatchId receiver, const DiscontinuityOptions& options) const;
  std::vector<Discontinuity> FindFrom(PatchId receiver, const PatchPair& pair, double strength,
                                      const DiscontinuityOptions& options,
                                      const ExecutionContext& context = ExecutionContext()) const;
  // The geometric weight, and the form factor of a source, are 1 at most.
  static bool Counts(double strength, const DiscontinuityOptions& options) {
    return strength > 0 && strength >= options.min_weight;
  }

  // Of a discontinuity of this scene at a point of its line, in the receiver's frame: JumpAt() across the
  // line.
  IrradianceJump Jump(const Discontinuity& d, const Vec2& at) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
