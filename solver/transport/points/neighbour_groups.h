// solver/transport/points/neighbour_groups.h
//
// Groups of points whose rays can be traced together.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solver/visibility/point/receiver_point.h"

namespace penumbra {

// The numbers of all points, each once, in groups of neighbours with equal normals: at most `most` in each
// group, ordered along a curve that fills space. REQUIRES: most > 0.
std::vector<std::vector<std::size_t>> GroupNeighbours(std::span<const ReceiverPoint> points,
                                                      std::size_t most);

}  // namespace penumbra
