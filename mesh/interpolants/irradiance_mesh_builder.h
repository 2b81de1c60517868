// mesh/interpolants/irradiance_mesh_builder.h
//
// Interpolants over triangulated patches (thesis 3.2, 3.3): six samples a triangle, each evaluated once.
//
// A node is a vertex or an edge midpoint. Its irradiance is the limit from inside the triangle that asks
// (6.3). Where the sampler says that the side matters, every triangle at the node gets a value of its own, so
// that nothing leaks across a contact (D0) edge, and each corner at the end of one has the value of its own
// direction (6.4).

#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/sample_cache.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/points/point_irradiance.h"

namespace penumbra {

// PointIrradiance::OnPatch(), or whatever stands in for it. Called from several threads at once.
using IrradianceSampler = std::function<PointIrradianceResult(PatchId, const ReceiverPoint&)>;
// PointIrradiance::NearlyOnPatch() with that tolerance. `exact` must outlive it.
IrradianceSampler NearSampler(const PointIrradiance& exact, double tolerance);
// The same, which gives nothing any more once it was cancelled. Both must outlive it.
IrradianceSampler WhileGoing(IrradianceSampler sampler, const ExecutionContext& context);

// ReceiverPoint::uncertainty of samples on the patch [m].
double SampleUncertainty(const Scene& scene, const Patch& patch);

struct BuiltMesh {
  IrradianceMesh mesh;
  std::size_t point_evaluations = 0;  // those of the sampler; what the cache knew is not counted
};

// The mesh of all patches, with linear or quadratic interpolants. Patches ascend, triangles keep their order.
// The result does not depend on the number of threads. REQUIRES: patches[i] belongs to patch i of the scene;
// order is not kConstant. With a cache, samples that it knows are not evaluated again, and new ones are
// added.
BuiltMesh BuildIrradianceMesh(const Scene& scene, std::span<const PatchTriangulation> patches,
                              InterpolantOrder order, const IrradianceSampler& sampler,
                              const ExecutionContext& context, SampleCache* cache = nullptr);

// The same triangles with the irradiance of their leaves in the solution [W/m^2], indexed by ElementId: flat
// shading of the constant basis.
IrradianceMesh BuildConstantMesh(std::span<const PatchTriangulation> patches,
                                 std::span<const Rgb> element_irradiance);

}  // namespace penumbra
