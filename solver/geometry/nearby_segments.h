// solver/geometry/nearby_segments.h
//
// Finds which of many segments in the plane come close to each other. Bounding boxes do not tell that of long
// slanted segments: the boxes of the spikes of a star overlap by the square of their number. The finder
// halves the plane again and again, by a line along one of the segments or by an upright or level line,
// whichever separates best (a binary space partition, Paterson and Yao 1990), and compares only segments that
// reach the same part.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "solver/geometry/vec.h"

namespace penumbra {

struct PlaneSegment {
  Vec2 a = Vec2::Zero(), b = Vec2::Zero();  // equal: a point
};

// Pairs (i, j), i < j, of segments, in ascending order: all whose distance is at most `distance`, and others
// that are not far from each other. Takes time O(n log n) for outlines that do not cross themselves; nullopt
// if it would take much more, because too many segments meet.
std::optional<std::vector<std::pair<std::int32_t, std::int32_t>>> FindNearbyPairs(
    std::span<const PlaneSegment> segments, double distance);

}  // namespace penumbra
