// solver/transport/points/neighbour_groups.h
//
// Groups of neighbouring points whose rays can be traced together as packets.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// Divides the points into groups of at most `most` neighbours with equal normals, and returns the indices of
// the points in each group. Points with equal normals are ordered along a space-filling curve (Morton).
// REQUIRES: most > 0.
std::vector<std::vector<std::size_t>> GroupNeighbours(std::span<const ReceiverPoint> points,
                                                      std::size_t most);

}  // namespace penumbra
