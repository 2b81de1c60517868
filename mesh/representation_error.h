// mesh/representation_error.h
//
// The error of what is shown: interpolants against the irradiance itself, at points that the construction
// never used.

#pragma once

#include <cstddef>
#include <cstdint>

#include "mesh/irradiance_mesh.h"
#include "mesh/irradiance_mesh_builder.h"
#include "solver/scene/scene.h"

namespace penumbra {

// Statistics over points and channels of |shown - true| / max(true, 1 % of that channel's mean irradiance).
struct RepresentationError {
  std::size_t points = 0;
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  PatchId worst_patch = kNoPatch;   // where the largest error was seen
  Vec3 worst_point = Vec3::Zero();  // [m]
};

// Measures at `points` random points that spread evenly by area over the fronts of all patches. The same seed
// gives the same points. Points are offset from all interpolation nodes with probability one.
RepresentationError MeasureRepresentationError(const Scene& scene, const IrradianceMesh& mesh,
                                               const IrradianceSampler& sampler, std::size_t points,
                                               std::uint64_t seed);

}  // namespace penumbra
