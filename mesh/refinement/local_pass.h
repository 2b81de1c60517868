// mesh/refinement/local_pass.h
//
// The second half of the offline computation (Lischinski, Tampieri and Greenberg's local pass): from the
// solution of the global pass to the irradiance mesh. Discontinuities, DSets, leaf triangulation,
// interpolants.

#pragma once

#include <optional>
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

// What a mesh is made of beyond the solution and its options: that which refinement asked for.
struct MeshPlan {
  ElementForest forest;                            // the solution's, or one that was grown from it
  std::vector<std::vector<Discontinuity>> wanted;  // per patch; none where it is shorter
};

struct MeshResult {
  IrradianceMesh mesh;
  MeshPlan plan;
  std::vector<PatchTriangulation> triangulations;  // that the mesh was made of
  MeshReport report;
};

// What a local pass leaves for the next one over the same scene, after an iteration or a division of leaves.
// It changes no result.
class LocalPassCache {
 public:
  // Both must outlive the cache.
  LocalPassCache(const Scene& scene, const PatchVisibility& visibility)
      : discontinuities(scene, visibility), leaves(scene.patches.size()) {}

  DiscontinuityCache discontinuities;
  std::vector<LeafMeshCache> leaves;  // per patch
};

// The largest radiosity of each patch, over its leaves and the channels [W/m^2].
std::vector<double> SourceStrengths(const RadiositySolution& solution);

// Which discontinuities of a patch a mesh goes without, though they weigh enough to be asked for.
struct OmittedOfPatch {
  std::vector<Discontinuity> found;
  std::vector<OmittedDiscontinuity> omitted;
};

// The solution's leaves, divided towards the ends of contacts as often as the options say.
MeshPlan BeginPlan(const PatchVisibility& visibility, const RadiositySolution& solution,
                   const DiscontinuityOptions& options);

// Triangulates the patches of a scene, as often as leaves are divided.
class PatchTriangulator {
 public:
  // Everything must outlive the object. Without a cache it has one of its own.
  PatchTriangulator(const PatchVisibility& visibility, const RadiositySolution& solution,
                    const DiscontinuityOptions& options, const ExecutionContext& context,
                    LocalPassCache* cache = nullptr);

  // From here on ranking by the irradiance weight asks the sampler how dark it is where discontinuities
  // compete for the room in a leaf (LeafIrradianceSamples). The sampler must outlive the object.
  void RankWith(const IrradianceSampler& sampler) { sampler_ = &sampler; }

  // Triangulates all patches along the leaves of the plan; counts and seconds are added to the report. The
  // mesh may split leaves further: the `leaves` of a triangulation name for each of its leaves that of the
  // plan that it is part of. `omitted`, if it is asked for, gets one for each patch, unless this was
  // cancelled. REQUIRES: the quadtrees are balanced.
  std::vector<PatchTriangulation> Triangulate(const MeshPlan& plan, MeshReport& report,
                                              std::vector<OmittedOfPatch>* omitted = nullptr);

 private:
  struct Work;

  std::vector<Discontinuity> FindOn(PatchId patch, const MeshPlan& plan) const;
  void FindAll(Work& work) const;
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
  std::optional<LocalPassCache> own_cache_;
  LocalPassCache& cache_;
  ReferenceIrradiance light_;
  std::vector<double> strength_;  // SourceStrengths()
};

// The whole local pass. The sampler is not called for constant interpolants. A cancelled run returns an empty
// mesh. REQUIRES: the quadtrees are balanced.
MeshResult RunLocalPass(const PatchVisibility& visibility, const RadiositySolution& solution,
                        const IrradianceSampler& sampler, const MeshOptions& options,
                        const ExecutionContext& context, LocalPassCache* cache = nullptr);

}  // namespace penumbra
