// solver/geometry/nearby_segments.h
//
// Finds the pairs of close segments among many segments in the plane. Bounding boxes do not help with long
// slanted segments: in a star with n spikes, the boxes of about n^2 pairs of edges overlap. The search uses a
// binary space partition (Paterson and Yao 1990), and compares only segments that reach the same cell. The
// line that divides a cell is vertical, horizontal, or along one of the segments, whichever separates the
// segments best.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct PlaneSegment {
  // The end points of the segment; if they are equal, the segment is a single point.
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();
};

// Returns pairs (i, j), i < j, of indices of segments, in ascending order. The result contains all pairs
// whose distance is at most `distance`, and may contain some pairs at a larger distance. For n segments that
// form outlines without self-crossings, the search takes time O(n log n). Returns nullopt if the search would
// take much longer than O(n log n), because too many segments meet.
std::optional<std::vector<std::pair<std::int32_t, std::int32_t>>> FindNearbyPairs(
    std::span<const PlaneSegment> segments, double distance);

}  // namespace penumbra
