// mesh/interpolants/irradiance_mesh_builder.h
//
// Interpolants over triangulated patches (thesis 3.2, 3.3) from six samples per triangle. Each sample is
// evaluated once.
//
// A node is a vertex or the midpoint of an edge. The irradiance at a node is the limit from the interior of
// the triangle that needs it (6.3). If the sampler reports a one-sided value, every triangle at the node gets
// its own value. Therefore no light leaks across a contact (D0) edge, and each corner at the end of a contact
// has the value for its own direction (6.4).

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

// PointIrradiance::OnPatch() or a replacement. Must be safe from several threads at once.
using IrradianceSampler = std::function<PointIrradianceResult(PatchId, const ReceiverPoint&)>;
// A sampler that calls PointIrradiance::NearlyOnPatch() with this tolerance. `exact` must outlive the
// sampler.
IrradianceSampler NearSampler(const PointIrradiance& exact, double tolerance);
// A sampler that calls PointIrradiance::RecordOnPatch() with this tolerance, so that samples have rows.
IrradianceSampler RecordingSampler(const PointIrradiance& exact, double tolerance);
// The same sampler, except that it returns an empty result after cancellation. `context` must outlive the
// result.
IrradianceSampler WhileGoing(IrradianceSampler sampler, const ExecutionContext& context);

// The value of ReceiverPoint::uncertainty for samples on the patch [m].
double SampleUncertainty(const Scene& scene, const Patch& patch);

struct BuiltMesh {
  IrradianceMesh mesh;
  std::size_t point_evaluations = 0;  // calls of the sampler, without the samples from the cache
};

// The mesh of all patches, with linear or quadratic interpolants. The order of patches and triangles is that
// of `patches`. The result does not depend on the number of threads. With a cache, the builder evaluates only
// samples that the cache lacks, and adds them to the cache. REQUIRES: patches[i] belongs to patch i of the
// scene; order is not kConstant.
BuiltMesh BuildIrradianceMesh(const Scene& scene, std::span<const PatchTriangulation> patches,
                              InterpolantOrder order, const IrradianceSampler& sampler,
                              const ExecutionContext& context, SampleCache* cache = nullptr);

// The same triangles with constant interpolants: the irradiance of each triangle's leaf. `element_irradiance`
// is indexed by ElementId [W/m^2].
IrradianceMesh BuildConstantMesh(std::span<const PatchTriangulation> patches,
                                 std::span<const Rgb> element_irradiance);

}  // namespace penumbra
