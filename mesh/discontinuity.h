// mesh/discontinuity.h
//
// Where the irradiance over a patch is not smooth (thesis, chapter 5): the traces of critical surfaces
// between sources, blockers and the patch.
//
// Notation: R receiver, S source, b a point of a blocker, x the point of R's plane on the line from S through
// b, h the height above R's plane. Everything lies on straight segments; triple-edge (EEE) surfaces are left
// out, as in the thesis 5.2.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "solver/geometry/polygon.h"
#include "solver/scene/scene.h"
#include "solver/visibility/patch_visibility.h"

namespace penumbra {

enum class DiscontinuityKind : std::uint8_t { kVE, kEV, kHorizon, kContact };

// The lowest derivative of the irradiance that jumps. Generic VE and EV events are D2, a horizon is D1 (so is
// a VE event whose source edge and blocker edge share a plane), a contact D0.
enum class DiscontinuityDegree : std::uint8_t { kD0, kD1, kD2 };

// A segment of nonzero length on the receiver (thesis 5.5.3).
struct Discontinuity {
  std::array<Vec2, 2> end = {Vec2::Zero(), Vec2::Zero()};  // in the frame PolygonFrame() of the receiver [m]
  DiscontinuityKind kind = DiscontinuityKind::kVE;
  DiscontinuityDegree degree = DiscontinuityDegree::kD2;
  PatchId receiver = kNoPatch;
  PatchId source = kNoPatch;    // kNoPatch for a contact
  PatchId blocker = kNoPatch;   // kNoPatch for a horizon; the touching patch for a contact
  double geometric_weight = 0;  // max(d_sb / d_sr), at most 1; 1 for a horizon, infinite for a contact
  double weight = 0;            // times the source's strength [W/m^2] (thesis 5.3)
};

inline constexpr double kInfiniteWeight = std::numeric_limits<double>::infinity();

// Finds the discontinuities on one receiver at a time. Lists which patches share an edge once, at
// construction.
class DiscontinuityFinder {
 public:
  // Both must outlive the finder.
  DiscontinuityFinder(const Scene& scene, const PatchVisibility& visibility);
  ~DiscontinuityFinder();
  DiscontinuityFinder(DiscontinuityFinder&&) noexcept;

  // All contacts on the receiver, and its VE, EV and horizon discontinuities whose weight is at least
  // `min_weight`. `source_strength` [W/m^2] holds for each patch the largest radiosity (over its leaves and
  // the channels).
  //  (1) Every segment lies on the receiver and is longer than SnapDistance().
  //  (2) The same input gives the same list, in the same order. Equal segments may occur several times.
  //  (3) A VE event of an edge that two patches share is left out where both face the source's vertex, or
  //  both look
  //      away: the edge is no silhouette. Its copy from the second patch is left out as well.
  //  (4) What comes within ContactGap() of the receiver touches it, and casts no shadow line of its own
  //  beside the
  //      contact.
  // Safe from any thread.
  std::vector<Discontinuity> Find(PatchId receiver, std::span<const double> source_strength,
                                  double min_weight) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace penumbra
