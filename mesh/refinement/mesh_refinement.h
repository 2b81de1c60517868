// mesh/refinement/mesh_refinement.h
//
// Representation-based refinement (thesis 4.4.2): refines the displayed mesh where its interpolants are
// inaccurate. Quadtree leaves where the error of the interpolants is too large are divided, or get more edges
// along discontinuities. Refinement affects only the mesh: sources and links remain unchanged, so that a
// finer mesh costs no more than additional samples.

#pragma once

#include <cstddef>
#include <functional>
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

// The fraction of the area of all reflecting patch fronts on which the error may exceed its limit.
// kShareAbove is smaller than 1 %, the fraction above a 99th percentile, because measurements at single
// points overlook some errors.
inline constexpr double kShareAbove = 0.005;

struct MeshRefinementOptions {
  // Triangles whose relative error exceeds `error` may cover at most the fraction share_above of the area of
  // all reflecting patch fronts (ReflectingAreas). Triangles on patches that reflect nothing have the same
  // limit: the fraction share_above of the area of these patches. In each part of the scene, for example an
  // object (PartsOf), the limit of the error is kPartError * error.
  double error = 0.02;
  double share_above = kShareAbove;
  double min_area = 0;  // the smallest permitted area of a quadtree leaf of the mesh [m^2]
  // Triangles whose estimated error (GuessTriangleErrors) is below suspicion * error are not measured. The
  // error estimate of GuessTriangleErrors() holds for light that is smooth at the scale of a triangle.
  double suspicion = 0.25;
  // A triangle is also measured at (samples + 1)^2 points if the irradiances at its vertices differ by more
  // than the factor `steep`.
  double steep = std::numeric_limits<double>::infinity();
  int samples = 1;  // each triangle is measured at samples^2 points (thesis, Appendix A)
  int max_rounds = 8;
  // Refinement ends when a mesh has more than max_triangles triangles, which take about 2 GB of memory with
  // their samples.
  std::size_t max_triangles = 2'000'000;
};

struct RefinedMesh {
  MeshPlan plan;  // the refined quadtree leaves, and the discontinuities that refinement requested
  std::vector<PatchTriangulation> triangulations;
  IrradianceMesh mesh;
  // The error of each triangle; zero for triangles that were not measured because the gradients of the
  // interpolants indicate a small error.
  std::vector<TriangleError> errors;
  MeshReport report;
  double share_above = 0;        // fraction of the reflecting area on triangles with errors above `error`
  std::vector<ElementId> unmet;  // leaves with errors above `error` that cannot be divided further
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
  // The quadtree leaves of the first mesh; null: those that BeginPlan() returns.
  const MeshPlan* start = nullptr;
  // The irradiance samples that are known already, from LightToShow::sampler.
  SampleCache* samples = nullptr;
  std::span<const KnownLight> known = {};  // points with known irradiance, at which each mesh is tested
  // The function that receives the mesh of each round of refinement.
  std::function<void(const IrradianceMesh&)> observer = {};
};

// Refines the mesh until the error exceeds its limit on at most the fraction share_above of the area, until
// no refinement step reduces the error, or until max_rounds rounds of refinement have been made. Each round
// of refinement takes the steps with the largest ratio (area that the step brings below the error limit) /
// (number of new triangles), and only as many steps as the limit on the area requires. A refinement step
// divides a quadtree leaf, or adds an edge along a discontinuity that had been omitted because of its small
// weight. If the computation is cancelled, the function returns the mesh of the last complete round; the mesh
// is empty if no round is complete. REQUIRES: the quadtrees are balanced.
RefinedMesh RefineMesh(const LightToShow& light, const MeshOptions& mesh_options,
                       const MeshRefinementOptions& options, const ExecutionContext& context,
                       const RefinementMemory& memory = {});

}  // namespace penumbra
