// mesh/refinement/emitter_interpolants.h
//
// The interpolants of each emitter alone, on the triangles of a mesh. The form factors of each mesh node
// (vertex or edge midpoint) to all sources are computed once, and give the node's irradiance from the light
// of each emitter.

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

// A function that makes the exact irradiance from a radiosity solution that holds the light of a single
// emitter. The function returns null if the computation is cancelled.
using IrradianceOf = std::function<std::unique_ptr<const PointIrradiance>(const RadiositySolution&)>;

struct EmitterInterpolation {
  const RadiositySolution& whole;  // radiosity solution whose light is the sum of all emitters' lights
  std::span<const PatchTriangulation> triangulations;
  const PointIrradiance& exact;  // exact irradiance from the light of all emitters
  // Makes the exact irradiance from a single emitter's light. The result of irradiance_of() is evaluated at
  // every mesh node if `exact` cannot record form factors (PointIrradiance::CanRecord).
  IrradianceOf irradiance_of;
  double tolerance = 0;  // tolerance of irradiance samples (PointIrradiance::RecordOnPatch)
};

// Sets EmitterLight::interpolant of all lights. All mesh nodes are sampled, and none is predicted from its
// neighbours, so that the interpolants are linear in the emittance. Returns the number of points whose
// irradiance was evaluated. If the computation is cancelled, the function returns 0, and the interpolants are
// incomplete.
std::size_t InterpolateByEmitter(const EmitterInterpolation& in, std::span<EmitterLight> lights,
                                 const ExecutionContext& context);

}  // namespace penumbra
