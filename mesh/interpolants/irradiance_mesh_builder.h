// mesh/interpolants/irradiance_mesh_builder.h
//
// Builds the irradiance interpolants over triangulated patches (thesis 3.2, 3.3) from six samples per
// triangle. Triangles share samples, and each sample is evaluated only once.
//
// A node of the mesh is a vertex or the midpoint of an edge of a triangle. The irradiance at a mesh node is
// the limit that is approached from the interior of the triangle that uses the sample (thesis 6.3). If the
// irradiance at a node depends on the direction of approach, every triangle at the node gets its own value.
// Along a straight contact or border, the limit of the irradiance at a node is the same for all directions on
// one side, and the triangles on this side share one value. Triangles on different sides of a contact (a D0
// edge, where the irradiance jumps) therefore share no value, and no light leaks across the edge. At the end
// point of a contact edge, each triangle stores the limit of the irradiance for points inside the triangle
// (thesis 6.4).

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

// The uncertainty of the positions of irradiance samples on the patch [m], for ReceiverPoint::uncertainty.
double SampleUncertainty(const Scene& scene, const Patch& patch);

struct Interpolation {
  InterpolantOrder order = InterpolantOrder::kQuadratic;
  // The irradiance at the midpoint of an edge is predicted from the vertices instead of sampled if the
  // irradiance bends little along the edge (MidpointPrediction). The irradiance is predicted if |predicted
  // irradiance - mean of the irradiances at the edge's ends| <= smooth / 2 * max(irradiance, 1 % of the mean
  // irradiance). If `smooth` is 0, all midpoints are sampled.
  double smooth = 0;

  Interpolation(InterpolantOrder of, double smoothness = 0)  // NOLINT: implicit conversion is intended
      : order(of), smooth(smoothness) {}
};

struct BuiltMesh {
  IrradianceMesh mesh;
  std::size_t point_evaluations = 0;     // the number of points at which the irradiance was computed
  std::vector<std::uint32_t> predicted;  // indices of triangles with predicted midpoints, ascending
  // For each triangle, the numbers of its six samples, counted in the order of the calls of the sampler. The
  // list sample_numbers is empty if samples came from a cache, were predicted, or belong to linear
  // interpolants.
  std::vector<std::array<std::uint32_t, 6>> sample_numbers;
};

// Builds the mesh of all patches, with linear or quadratic interpolants. The triangles of the mesh are in the
// order of `patches`, and within a patch in the order of its triangulation. The resulting mesh does not
// depend on the number of threads. If `cache` is not null, only samples that are not in the cache are
// evaluated, and the new samples are added to the cache. REQUIRES: patches[i] is the triangulation of patch i
// of the scene, and the order of the interpolants is not kConstant.
BuiltMesh BuildIrradianceMesh(const Scene& scene, std::span<const PatchTriangulation> patches,
                              const Interpolation& how, const IrradianceSampler& sampler,
                              const ExecutionContext& context, SampleCache* cache = nullptr);

// Samples the irradiance at the edge midpoints of the listed triangles, and adds the samples to the cache. A
// mesh that is built with the cache filled by SampleMidpoints() uses these samples instead of predictions.
// Returns the number of calls of the sampler.
std::size_t SampleMidpoints(const Scene& scene, const IrradianceMesh& mesh,
                            std::span<const std::uint32_t> triangles, const IrradianceSampler& sampler,
                            const ExecutionContext& context, SampleCache& cache);

// Builds the mesh of all patches with constant interpolants: each triangle has the mean irradiance of its
// quadtree leaf. `element_irradiance` [W/m^2] holds the irradiance of each quadtree element, indexed by
// ElementId.
IrradianceMesh BuildConstantMesh(std::span<const PatchTriangulation> patches,
                                 std::span<const Rgb> element_irradiance);

}  // namespace penumbra
