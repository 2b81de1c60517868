// mesh/refinement/local_pass.h
//
// The local pass (Lischinski, Tampieri and Greenberg), the second half of the offline computation. The local
// pass computes the irradiance mesh from the solution of the global pass in four steps: discontinuities,
// DSets, the triangulation of leaves, and interpolants.

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

// The leaves and the requested discontinuities from which a mesh is computed, in addition to the solution and
// the options. Refinement of the mesh adds leaves and discontinuities to the plan.
struct MeshPlan {
  ElementForest forest;                            // the solution's, or grown from it
  std::vector<std::vector<Discontinuity>> wanted;  // per patch; patches beyond its end have none
};

struct MeshResult {
  IrradianceMesh mesh;
  MeshPlan plan;
  std::vector<PatchTriangulation> triangulations;  // the source of the mesh
  MeshReport report;
};

// Data that one local pass computes and a later local pass over the same scene reuses, for example after an
// iteration or after a division of leaves. The cache saves time and does not change results.
class LocalPassCache {
 public:
  // Scene and visibility must outlive the cache.
  LocalPassCache(const Scene& scene, const PatchVisibility& visibility)
      : discontinuities(scene, visibility), leaves(scene.patches.size()) {}

  DiscontinuityCache discontinuities;
  std::vector<LeafMeshCache> leaves;  // per patch
};

// For each patch, the maximum radiosity over the patch's leaves and the channels [W/m^2].
std::vector<double> SourceStrengths(const RadiositySolution& solution);

// The discontinuities found on a patch, and those of them that are not edges of the mesh but may be requested
// by refinement.
struct OmittedOfPatch {
  std::vector<Discontinuity> found;
  std::vector<OmittedDiscontinuity> omitted;
};

// The plan of the first mesh. The leaves of the plan are the solution's leaves, except that leaves at the
// ends of contacts are divided options.corner_divisions times.
MeshPlan BeginPlan(const PatchVisibility& visibility, const RadiositySolution& solution,
                   const DiscontinuityOptions& options);

// Triangulates the patches of a scene. The object can be used again after leaves have been divided.
class PatchTriangulator {
 public:
  // All arguments must outlive the object. If `cache` is null, the object uses its own cache.
  PatchTriangulator(const PatchVisibility& visibility, const RadiositySolution& solution,
                    const DiscontinuityOptions& options, const ExecutionContext& context,
                    LocalPassCache* cache = nullptr);

  // After this call, if discontinuities are ranked by DiscontinuityWeight::kIrradiance and a leaf has no room
  // for all of them, the sampler computes the irradiance at the discontinuities (LeafIrradianceSamples). The
  // sampler must outlive the object.
  // `samples`, unless null, holds samples of this sampler, and gets those that ranking takes.
  void RankWith(const IrradianceSampler& sampler, SampleCache* samples = nullptr) {
    sampler_ = &sampler;
    samples_ = samples;
  }

  // Triangulates all patches along the leaves of the plan, and adds counts and seconds to `report`. Leaves
  // may be split further for the mesh; for each leaf of a triangulation, PatchTriangulation::leaves holds the
  // leaf of the plan that contains it. If `omitted` is not null, it receives one entry for each patch, unless
  // the context is cancelled. REQUIRES: the quadtrees are balanced.
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
  std::vector<double> strength_;  // SourceStrengths()
  // The last activation of a patch. It holds until the patch gets other leaves, or refinement wants another
  // discontinuity there.
  struct Activation {
    std::vector<ElementId> leaves;  // of the plan; empty: none
    std::size_t wanted = 0;         // number of wanted discontinuities
    bool lists_omitted = false;
    // Elements that were split because they were crowded, in this order, each with its first child.
    std::vector<std::pair<ElementId, ElementId>> splits;
    PatchDSets dsets;
  };
  std::vector<Activation> activations_;  // by patch
};

// Data from an earlier local pass; each member may be null.
struct LocalPassMemory {
  LocalPassCache* cache = nullptr;
  SampleCache* samples = nullptr;  // samples of the same sampler
};

// The complete local pass. For constant interpolants, the sampler is not called. If cancelled, the function
// returns an empty mesh. REQUIRES: the quadtrees are balanced.
MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context, const LocalPassMemory& memory = {});

}  // namespace penumbra
