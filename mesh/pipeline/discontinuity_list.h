// mesh/pipeline/discontinuity_list.h
//
// All discontinuities of a solution in one list, for inspection. The computation of the mesh finds the
// discontinuities of each receiver separately, and does not use a DiscontinuityList.

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
  // All discontinuities of the irradiance, in the order of their receivers.
  std::vector<Discontinuity> all;
  std::vector<std::array<Vec3, 2>> ends;  // the two end points of each discontinuity, in space [m]
};

// Returns the discontinuities on all patches that may become edges of the mesh, including those that
// refinement may request. The list holds the results of DiscontinuityFinder::Find() for the radiosities of
// the solution. The list of discontinuities is empty if the computation is cancelled.
DiscontinuityList ListDiscontinuities(const RadiositySolution& solution, const PatchVisibility& visibility,
                                      const DiscontinuityOptions& options, const ExecutionContext& context);

}  // namespace penumbra
