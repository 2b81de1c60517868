// mesh/refinement/local_pass.h
//
// The local pass (Lischinski, Tampieri and Greenberg), the second half of the offline computation. The local
// pass computes the irradiance mesh from the solution of the global pass in four steps. The four steps of the
// local pass find discontinuities, choose those that become edges (DSets), triangulate quadtree leaves, and
// compute interpolants.

#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/discontinuity_cache.h"
#include "mesh/discontinuities/dset.h"
#include "mesh/discontinuities/mesh_options.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/leaf_irradiance_samples.h"
#include "mesh/interpolants/reference_irradiance.h"
#include "mesh/triangulation/leaf_triangulation.h"
#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/solution.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// A mesh plan holds the quadtree leaves and the requested discontinuities of a mesh. A mesh is computed from
// a mesh plan, a radiosity solution and options. Refinement of a mesh adds leaves and discontinuities to the
// mesh plan.
struct MeshPlan {
  ElementForest forest;  // the quadtrees of the solution, or finer ones
  // The discontinuities on each patch that refinement has requested as edges. A patch beyond the end of the
  // list `wanted` has no requested discontinuities.
  std::vector<std::vector<Discontinuity>> wanted;
};

struct MeshResult {
  IrradianceMesh mesh;
  MeshPlan plan;
  // The triangulations of the patches from which `mesh` was made.
  std::vector<PatchTriangulation> triangulations;
  MeshReport report;
};

// Data that one local pass computes and a later local pass over the same scene reuses, for example after an
// iteration or after a division of leaves. The LocalPassCache saves time and does not change results.
class LocalPassCache {
 public:
  // Scene and visibility must outlive the LocalPassCache.
  LocalPassCache(const Scene& scene, const PatchVisibility& visibility)
      : discontinuities(scene, visibility), leaves(scene.patches.size()) {}

  DiscontinuityCache discontinuities;
  std::vector<LeafMeshCache> leaves;  // the triangulated quadtree leaves of each patch
};

// For each patch, the maximum radiosity over the patch's leaves and the channels [W/m^2].
std::vector<double> SourceStrengths(const RadiositySolution& solution);

// The discontinuities found on a patch, and the subset that consists of discontinuities that are no edges of
// the mesh but that refinement may request.
struct OmittedOfPatch {
  std::vector<Discontinuity> found;
  std::vector<OmittedDiscontinuity> omitted;
};

// Returns the mesh plan (quadtree leaves and requested discontinuities) of the first mesh of a solution. In
// the first mesh plan, the leaves are the solution's leaves, except that leaves at the ends of contacts
// (lines where surfaces touch) are divided options.corner_divisions times.
MeshPlan BeginPlan(const PatchVisibility& visibility, const RadiositySolution& solution,
                   const DiscontinuityOptions& options);

// Triangulates all patches of a scene. A PatchTriangulator can be used again after quadtree leaves have been
// divided.
class PatchTriangulator {
 public:
  // All constructor arguments must outlive the PatchTriangulator. If `cache` is null, the PatchTriangulator
  // uses its own cache.
  PatchTriangulator(const PatchVisibility& visibility, const RadiositySolution& solution,
                    const DiscontinuityOptions& options, const ExecutionContext& context,
                    LocalPassCache* cache = nullptr);

  // If a leaf has no room for all its discontinuities, and these discontinuities are ranked by
  // DiscontinuityWeight::kIrradiance, `sampler` computes the irradiance at the discontinuities
  // (LeafIrradianceSamples). The sampler must outlive the PatchTriangulator. `samples`, unless null, holds
  // samples of `sampler`, and receives the samples that the ranking takes in addition.
  void RankWith(const IrradianceSampler& sampler, SampleCache* samples = nullptr) {
    sampler_ = &sampler;
    samples_ = samples;
  }

  // Triangulates all patches along the quadtree leaves of the mesh plan, and adds counts and run times to
  // `report`. Leaves of the mesh plan may be split further for the mesh. For each triangulated leaf,
  // PatchTriangulation::leaves names the leaf of the mesh plan that contains the triangulated leaf. If
  // `omitted` is not null, the list receives an OmittedOfPatch for each patch, unless the computation is
  // cancelled. REQUIRES: the quadtrees are balanced.
  std::vector<PatchTriangulation> Triangulate(const MeshPlan& plan, MeshReport& report,
                                              std::vector<OmittedOfPatch>* omitted = nullptr);

 private:
  struct Work;

  std::vector<Discontinuity> FindOn(PatchId patch, const MeshPlan& plan) const;
  void FindAll(Work& work) const;
  void RecallActivations(Work& work) const;
  void KeepActivations(const Work& work);
  PatchDSets Activate(const Work& work, std::size_t patch, LeafIrradianceSamples* places = nullptr) const;
  void ActivateAll(Work& work) const;
  void ActivateByPlaces(Work& work) const;
  std::vector<PatchTriangulation> TriangulateAll(const Work& work) const;
  void Count(const Work& work, const PatchTriangulation& triangulated, std::size_t patch) const;

  const PatchVisibility& visibility_;
  const RadiositySolution& solution_;
  DiscontinuityOptions options_;
  const ExecutionContext& context_;
  const IrradianceSampler* sampler_ = nullptr;
  SampleCache* samples_ = nullptr;
  std::optional<LocalPassCache> own_cache_;
  LocalPassCache& cache_;
  ReferenceIrradiance light_;
  std::vector<double> strength_;  // largest radiosity of each patch (SourceStrengths) [W/m^2]
  // The latest choice of the discontinuities of a patch that become edges of the mesh. The choice of
  // discontinuities holds until the patch gets other leaves, or until refinement requests another
  // discontinuity on the patch.
  struct Activation {
    // The quadtree leaves for which discontinuities were chosen; empty if none have been chosen yet.
    std::vector<ElementId> leaves;
    // The number of discontinuities that refinement of the mesh has requested as edges.
    std::size_t wanted = 0;
    bool lists_omitted = false;
    // Quadtree elements that were split because they had no room for a discontinuity, in the order of the
    // splits, each with its first child.
    std::vector<std::pair<ElementId, ElementId>> splits;
    PatchDSets dsets;
  };
  std::vector<Activation> activations_;  // latest choice of discontinuities for each patch
};

// Data from an earlier local pass; each member may be null.
struct LocalPassMemory {
  LocalPassCache* cache = nullptr;
  // The irradiance samples that are known already, from the sampler passed to RunLocalPass().
  SampleCache* samples = nullptr;
};

// Runs the complete local pass, which computes the irradiance mesh from a radiosity solution. For constant
// interpolants, the sampler is not called. If the computation is cancelled, the function returns an empty
// mesh. REQUIRES: the quadtrees are balanced.
MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context, const LocalPassMemory& memory = {});

}  // namespace penumbra
