// mesh/source_error.h
//
// What the constant radiosities of the solution's leaves cost where their light arrives.

#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/irradiance_mesh.h"
#include "mesh/irradiance_mesh_builder.h"
#include "solver/transport/solution.h"

namespace penumbra {

// An estimate of the 99th percentile, over points spread evenly on the fronts and over the channels, of the
// relative error |E - E'| / max(E, 1 % of the channel's mean), where E' comes from the leaves' radiosities
// and E from what the interpolants make of them. At each point cosine-distributed rays compare the two where
// they hit; the noise of the rays adds to the estimate (about the spread of radiosity within a leaf over the
// square root of kRaysOfSourceError).
double EstimateSourceError(const RadiositySolution& solution, const IrradianceMesh& mesh,
                           const IrradianceSampler& sampler, std::size_t points, std::uint64_t seed);

inline constexpr std::size_t kRaysOfSourceError = 256;

}  // namespace penumbra
