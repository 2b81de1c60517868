// mesh/refinement/mesh_refinement.h
//
// Representation-based refinement (thesis 4.4.2) of what is shown: leaves on which the interpolants are too
// far from the irradiance are divided or get further edges, for the mesh only. The sources and their links
// stay as they are, so that a finer picture costs samples and nothing else.

#pragma once

#include <cstddef>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/interpolants/sample_cache.h"
#include "mesh/interpolants/triangle_error.h"
#include "mesh/refinement/local_pass.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

struct MeshRefinementOptions {
  // The relative error that all but kShareAbove of the area shall keep to, of the fronts that are seen and of
  // those that are not; of each part of the scene (PartsOf) kPartError times that.
  double error = 0.02;
  double min_area = 0;  // no leaf becomes smaller [m^2]
  int samples = 1;      // a triangle is measured at samples x samples points (thesis, Appendix A)
  int max_rounds = 8;
  std::size_t max_triangles = 2'000'000;  // no round begins with more: some 2 GB with their samples
};

// Of the fronts' area: what the 99th percentile leaves, less what measuring at single points overlooks.
inline constexpr double kShareAbove = 0.006;

struct RefinedMesh {
  MeshPlan plan;  // the leaves that were divided for the mesh, and the discontinuities that it wants
  std::vector<PatchTriangulation> triangulations;
  IrradianceMesh mesh;
  // One a triangle; zero where the interpolants' gradients give no reason to measure.
  std::vector<TriangleError> errors;
  MeshReport report;
  double share_above = 0;        // of the area that is seen, on triangles found to err by more than asked
  std::vector<ElementId> unmet;  // leaves that err by more than asked and cannot be divided
};

// The light that a mesh is to show.
struct LightToShow {
  const PatchVisibility& visibility;
  const RadiositySolution& solution;
  IrradianceSampler sampler;
};

// What refinement takes over from an earlier one, as far as there is any.
struct RefinementMemory {
  LocalPassCache* local_pass = nullptr;
  const MeshPlan* start = nullptr;  // what it begins with; BeginPlan() if it is null
  SampleCache* samples = nullptr;   // what was evaluated, with the same sampler
};

// Refines until the share is small enough, nothing is left to do, or the most rounds are done. A round takes
// those steps that promise most for what they cost, and no more than it takes: leaves are divided, and
// discontinuities too light for the mesh become edges. Cancelled, it returns an empty mesh.
// REQUIRES: the leaves are balanced.
RefinedMesh RefineMesh(const LightToShow& light, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       const RefinementMemory& memory = {});

}  // namespace penumbra
