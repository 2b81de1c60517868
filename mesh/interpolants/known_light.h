// mesh/interpolants/known_light.h
//
// Known irradiance at points that are independent of any mesh. Measurements at fixed places of each triangle
// can miss a shadow that lies within one large triangle. Points with known irradiance reveal such a small
// shadow in every later mesh.

#pragma once

#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_sampler.h"
#include "mesh/interpolants/triangle_error.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct KnownLight {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();  // the position of the point on its patch [m]
  Rgb irradiance = Rgb::Zero();  // exact irradiance at the point [W/m^2]
};

// Returns a sampler that appends its samples to `known`, and that one thread at a time may use. `known` must
// outlive the returned sampler.
IrradianceSampler Remembering(IrradianceSampler sampler, std::vector<KnownLight>& known);

// Raises the maximum error of each triangle that contains a point of `known` to the error of the interpolant
// at this point, as MeasureTriangles() with `sampling` defines errors. REQUIRES: `errors` has one entry for
// each triangle of the mesh.
void RaiseErrors(const Scene& scene, const IrradianceMesh& mesh, std::span<const KnownLight> known,
                 const TriangleSampling& sampling, std::span<TriangleError> errors);

}  // namespace penumbra
