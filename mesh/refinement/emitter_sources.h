// mesh/refinement/emitter_sources.h
//
// Computes the light of each emitter alone, for the light sources (quadtree leaves and their fragments) of a
// radiosity solution. Each emitter's light is transported over the same elements, links and fragments as the
// light of all emitters together. Where mesh interpolants have refined the sources, each emitter's light also
// uses the same mesh and the same form factors of mesh nodes. Only the emittance differs from emitter to
// emitter, so that each emitter's light needs multiplications by known form factors only.

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/sample_cache.h"
#include "mesh/refinement/emitter_light.h"
#include "mesh/refinement/source_cells.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/solvers/light_solver.h"

namespace penumbra {

// The mesh whose interpolants have refined the sources of a solution.
struct SourceMesh {
  const ElementForest& forest;  // the quadtrees whose leaves were triangulated
  std::span<const PatchTriangulation> triangulations;
  Interpolation how;
  std::span<const SourceCell> cells;  // pieces of quadtree leaves that act as light sources
  const PointIrradiance& exact;       // exact irradiance from the light of all emitters
  // The irradiance samples at the nodes of the mesh, with their form factors.
  SampleCache& samples;
  SourceSet& samples_from;  // the light sources to which the form factors of `samples` belong
  // `tolerance` is the tolerance of the form factors. The iteration ends when the light of the sources
  // changes by at most `settled` (SourceCells::Change).
  double tolerance = 0, settled = 0;
};

// Returns the light of each emitter, without interpolants. If `mesh` is null, LightSolver::LitAs() computes
// the light of each emitter. If `mesh` is not null, each source repeatedly gets the mean of the interpolants
// over the source as its irradiance, as in ShownMesh::RefineLight(). Form factors in mesh->samples that are
// too inaccurate for some emitter's light are renewed, and mesh->samples_from becomes the set of sources to
// which the renewed form factors belong. The result is nullopt if the computation is cancelled, or if the
// solver does not implement LitAs(). REQUIRES: `mesh` belongs to the present light of `whole`, and
// mesh->exact.CanRecord() is true.
std::optional<std::vector<EmitterLight>> SolveByEmitter(const LightSolver& whole,
                                                        std::span<const std::vector<PatchId>> emitters,
                                                        const SourceMesh* mesh,
                                                        const ExecutionContext& context);

}  // namespace penumbra
