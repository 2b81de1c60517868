// mesh/refinement/emitter_interpolants.h
//
// The interpolants of each emitter alone, on the triangles of a mesh. Each node of the mesh is looked at
// once: its row of form factors gives the light of all emitters.

#pragma once

#include <functional>
#include <memory>
#include <span>

#include "mesh/refinement/emitter_light.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

// Makes the irradiance from a solution with the same elements; null if cancelled.
using IrradianceOf = std::function<std::unique_ptr<const PointIrradiance>(const RadiositySolution&)>;

struct EmitterInterpolation {
  const RadiositySolution& whole;  // whose light is the sum of the lights
  std::span<const PatchTriangulation> triangulations;
  const PointIrradiance& exact;  // from the whole light
  // For irradiance that has no rows (PointIrradiance::CanRecord): each emitter's own, point by point.
  IrradianceOf irradiance_of;
  double tolerance = 0;  // of samples
};

// Sets EmitterLight::interpolant of all lights; nodes are not predicted, so that the interpolants are linear
// in the emittance. Returns the number of points whose irradiance was evaluated; 0 if cancelled, with
// incomplete interpolants.
std::size_t InterpolateByEmitter(const EmitterInterpolation& in, std::span<EmitterLight> lights,
                                 const ExecutionContext& context);

}  // namespace penumbra
