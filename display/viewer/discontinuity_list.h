// display/viewer/discontinuity_list.h

#pragma once

#include <array>
#include <vector>

#include "display/viewer/snapshot.h"
#include "mesh/discontinuity.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// All potential discontinuities of a solution, whatever their weight (thesis B.4.4), by receiver.
struct DiscontinuityList {
  std::vector<Discontinuity> all;
  std::vector<std::array<Vec3, 2>> ends;  // of each, in space [m]
};
DiscontinuityList ListDiscontinuities(const LightState& light, const ExecutionContext& context);

}  // namespace penumbra::viewer
