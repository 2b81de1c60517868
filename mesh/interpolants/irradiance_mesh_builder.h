// mesh/interpolants/irradiance_mesh_builder.h
//
// Interpolants over triangulated patches (thesis 3.2, 3.3) from six samples per triangle. Each sample is
// evaluated once.
//
// A node is a vertex or the midpoint of an edge. The irradiance at a node is the limit from the interior of
// the triangle that needs it (6.3). If the sampler reports a one-sided value, every triangle at the node gets
// its own value; along a straight contact or border, where the limit does not depend on the direction, the
// triangles on one side share it. Triangles on different sides of a contact (D0) edge therefore share no
// value, and no light leaks across the edge. At the end point of a contact edge, each triangle stores the
// limit that a point inside this triangle approaches (6.4).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_sampler.h"
#include "mesh/interpolants/sample_cache.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"

namespace penumbra {

// The value of ReceiverPoint::uncertainty for samples on the patch [m].
double SampleUncertainty(const Scene& scene, const Patch& patch);

struct Interpolation {
  InterpolantOrder order = InterpolantOrder::kQuadratic;
  // Midpoints of edges where the irradiance bends little are predicted from the vertices instead of sampled
  // (MidpointPrediction). A midpoint is predicted if |bend| <= smooth / 2 * max(irradiance, 1 % of the mean
  // irradiance). If `smooth` is 0, all midpoints are sampled.
  double smooth = 0;

  Interpolation(InterpolantOrder of, double smoothness = 0)  // NOLINT: an order is an interpolation
      : order(of), smooth(smoothness) {}
};

struct BuiltMesh {
  IrradianceMesh mesh;
  std::size_t point_evaluations = 0;     // calls of the sampler, without the samples from the cache
  std::vector<std::uint32_t> predicted;  // the triangles with midpoints that were not sampled, ascending
  // For each triangle, the numbers of its six samples, in the order in which the sampler was asked for them;
  // empty if samples came from a cache, were predicted, or are those of a linear interpolant.
  std::vector<std::array<std::uint32_t, 6>> sample_numbers;
};

// The mesh of all patches, with linear or quadratic interpolants. The order of patches and triangles is that
// of `patches`. The result does not depend on the number of threads. If `cache` is not null, only samples
// that are not in the cache are evaluated, and they are added to the cache. REQUIRES: patches[i] is the
// triangulation of patch i of the scene; order is not kConstant.
BuiltMesh BuildIrradianceMesh(const Scene& scene, std::span<const PatchTriangulation> patches,
                              const Interpolation& how, const IrradianceSampler& sampler,
                              const ExecutionContext& context, SampleCache* cache = nullptr);

// Samples the midpoints of the edges of the listed triangles, and adds the samples to the cache. A mesh that
// is built with this cache does not predict them. Returns the number of calls of the sampler.
std::size_t SampleMidpoints(const Scene& scene, const IrradianceMesh& mesh,
                            std::span<const std::uint32_t> triangles, const IrradianceSampler& sampler,
                            const ExecutionContext& context, SampleCache& cache);

// The mesh of all patches with constant interpolants: each triangle has the irradiance of its leaf.
// `element_irradiance` [W/m^2] is indexed by ElementId.
IrradianceMesh BuildConstantMesh(std::span<const PatchTriangulation> patches,
                                 std::span<const Rgb> element_irradiance);

}  // namespace penumbra
