// mesh/refinement/mesh_refinement.h
//
// Representation-based refinement (thesis 4.4.2) of the shown mesh. Leaves where the error of the
// interpolants is too large are divided or get more edges. Refinement affects only the mesh: sources and
// links remain unchanged, so that a finer mesh costs no more than additional samples.

#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/known_light.h"
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

// The fraction of the fronts' area that may exceed the error: the 1 % above a 99th percentile, minus an
// allowance for errors that measurements at single points overlook.
inline constexpr double kShareAbove = 0.005;

struct MeshRefinementOptions {
  // The fronts whose relative error exceeds `error` may cover at most the fraction share_above of the area of
  // all fronts that reflect (ReflectingAreas). The same holds for the other fronts, among themselves. In each
  // part of the scene (PartsOf), the limit of the error is kPartError * error.
  double error = 0.02;
  double share_above = kShareAbove;
  double min_area = 0;  // no leaf becomes smaller than this [m^2]
  // Triangles whose estimated error (GuessTriangleErrors) is below this fraction of `error` are not measured.
  // The estimate holds for light that is smooth at the scale of a triangle.
  double suspicion = 0.25;
  // Triangles whose vertices differ by more than this factor are measured at finer points, too.
  double steep = std::numeric_limits<double>::infinity();
  int samples = 1;  // per side of a triangle: samples^2 points measure it (thesis, Appendix A)
  int max_rounds = 8;
  std::size_t max_triangles = 2'000'000;  // no round starts with more: about 2 GB with their samples
};

struct RefinedMesh {
  MeshPlan plan;  // with the leaves divided, and the discontinuities wanted, for the mesh
  std::vector<PatchTriangulation> triangulations;
  IrradianceMesh mesh;
  // The error of each triangle; zero for triangles that were not measured because the gradients of the
  // interpolants indicate a small error.
  std::vector<TriangleError> errors;
  MeshReport report;
  double share_above = 0;        // fraction of the seen area on triangles with errors above `error`
  std::vector<ElementId> unmet;  // leaves with errors above `error` that cannot be divided
};

// The light that a mesh represents by its interpolants.
struct LightToShow {
  const PatchVisibility& visibility;
  const RadiositySolution& solution;
  IrradianceSampler sampler;
};

// Data from an earlier refinement that RefineMesh() reuses; each member may be null.
struct RefinementMemory {
  LocalPassCache* local_pass = nullptr;
  const MeshPlan* start = nullptr;         // the initial plan; BeginPlan() if null
  SampleCache* samples = nullptr;          // samples of the same sampler
  std::span<const KnownLight> known = {};  // additional points that test each mesh
};

// Refines the mesh until the error exceeds its limit on at most the fraction share_above of the area,
// until no step reduces the error, or until max_rounds rounds have been made. Each round chooses the steps
// with the largest benefit / cost, and no more steps than necessary. A step divides a leaf, or adds an edge
// along a discontinuity that had been omitted because of its small weight. If cancelled, the function returns
// an empty mesh. REQUIRES: the leaves are balanced.
RefinedMesh RefineMesh(const LightToShow& light, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       const RefinementMemory& memory = {});

}  // namespace penumbra
