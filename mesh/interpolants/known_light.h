// mesh/interpolants/known_light.h
//
// Irradiance that is known at points which no mesh was made for. Measurements at fixed places of each
// triangle can miss a shadow that lies within one large triangle; points known elsewhere reveal it, in every
// later mesh.

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
  Vec3 position = Vec3::Zero();  // [m]
  Rgb irradiance = Rgb::Zero();  // [W/m^2]
};

// A sampler that appends what it samples to `known`, for one thread at a time. `known` must outlive the
// sampler.
IrradianceSampler Remembering(IrradianceSampler sampler, std::vector<KnownLight>& known);

// Raises the maximum error of each triangle that contains a known point to the error of the interpolant at
// the point, as MeasureTriangles() defines it. `mean` is the mean irradiance of each channel [W/m^2].
// REQUIRES: one error for each triangle of the mesh.
void RaiseErrors(const Scene& scene, const IrradianceMesh& mesh, std::span<const KnownLight> known,
                 const Rgb& mean, std::span<TriangleError> errors);

}  // namespace penumbra
