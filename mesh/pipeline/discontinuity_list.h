// mesh/pipeline/discontinuity_list.h
//
// All discontinuities of a solution in one list, to look at: the mesh finds them receiver by receiver.

#pragma once

#include <array>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/mesh_options.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

struct DiscontinuityList {
  std::vector<Discontinuity> all;         // by receiver
  std::vector<std::array<Vec3, 2>> ends;  // of each, in space [m]
};

// What may become an edge of the mesh, if only because refinement asks for it: what
// DiscontinuityFinder::Find() finds on all patches, for the radiosities of the solution. None, if it was
// cancelled.
DiscontinuityList ListDiscontinuities(const RadiositySolution& solution, const PatchVisibility& visibility,
                                      const DiscontinuityOptions& options, const ExecutionContext& context);

}  // namespace penumbra
