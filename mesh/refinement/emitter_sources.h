// mesh/refinement/emitter_sources.h
//
// The light of each emitter alone on the sources of a solution. The operator is that of the whole light: the
// same elements, links, fragments and, where interpolants have refined the sources, the same mesh with the
// same rows of form factors. Only the emittance differs from emitter to emitter, so that each light takes
// products, and no form factors.

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
  const ElementForest& forest;  // of the triangulations
  std::span<const PatchTriangulation> triangulations;
  Interpolation how;
  std::span<const SourceCell> cells;  // the sources
  const PointIrradiance& exact;       // from the whole light
  SampleCache& samples;               // of the mesh's nodes, with rows
  SourceSet& samples_from;            // the sources to which the rows belong
  double tolerance = 0, settled = 0;  // of rows; the change of sources below which no turn follows
};

// The light of each emitter, without interpolants. If `mesh` is null, the light is that of
// LightSolver::LitAs(). Otherwise the sources get the means of the interpolants in turns, as in
// ShownMesh::RefineLight(); the rows in mesh->samples are renewed where they do not hold for the light of
// every emitter, and mesh->samples_from becomes the set to which they belong then. Nothing if cancelled, or
// if the solver has no LitAs(). REQUIRES: `mesh` belongs to the present light of `whole`, and
// mesh->exact.CanRecord().
std::optional<std::vector<EmitterLight>> SolveByEmitter(const LightSolver& whole,
                                                        std::span<const std::vector<PatchId>> emitters,
                                                        const SourceMesh* mesh,
                                                        const ExecutionContext& context);

}  // namespace penumbra
