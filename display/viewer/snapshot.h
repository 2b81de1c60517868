// display/viewer/snapshot.h
//
// Immutable states of the solution that the solver's thread passes to the view. Because snapshots do not
// change, the view can draw one state while the solver computes the next state.

#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "display/reconstruction.h"
#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra::viewer {

// The radiosity solution after a step of the solver, together with the objects that must live as long as the
// solution.
class LightState {
 public:
  LightState(std::shared_ptr<const Scene> scene, std::shared_ptr<const PatchVisibility> visibility,
             RadiositySolution solution, const PointIrradianceOptions& options,
             const DiscontinuityOptions& discontinuities = {})
      : scene_(std::move(scene)),
        visibility_(std::move(visibility)),
        solution_(std::move(solution)),
        options_(options),
        discontinuities_(discontinuities) {}

  const Scene& scene() const { return *scene_; }
  const PatchVisibility& visibility() const { return *visibility_; }
  const RadiositySolution& solution() const { return solution_; }
  // The options by which shadow discontinuities are chosen for a mesh of this solution.
  const DiscontinuityOptions& discontinuities() const { return discontinuities_; }

  // The object that computes exact irradiance; the first call of Exact() creates the object. Several threads
  // may call Exact() at once.
  const PointIrradiance& Exact() const {
    std::call_once(made_, [this] { exact_.emplace(solution_, *visibility_, options_); });
    return *exact_;
  }

  // The light that is reconstructed from the vertices of leaves; the first call for each kind computes it.
  // Returns null if the computation is cancelled. Several threads may call Reconstructed() at once.
  std::shared_ptr<const ReconstructedLight> Reconstructed(Reconstruction kind,
                                                          const ExecutionContext& context) const;

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const PatchVisibility> visibility_;
  RadiositySolution solution_;
  PointIrradianceOptions options_;
  DiscontinuityOptions discontinuities_;
  mutable std::once_flag made_;
  mutable std::optional<PointIrradiance> exact_;
  mutable std::mutex reconstructing_;
  mutable std::map<Reconstruction, std::shared_ptr<const ReconstructedLight>> reconstructed_;
};

// A mesh of triangles with the light of a radiosity solution (LightState).
class MeshState {
 public:
  MeshState(std::shared_ptr<const Scene> scene, IrradianceMesh mesh)
      : scene_(std::move(scene)), mesh_(std::move(mesh)) {}

  const Scene& scene() const { return *scene_; }
  const IrradianceMesh& mesh() const { return mesh_; }
  // The object that finds the triangle at a point; the first call of Locator() creates the object. Several
  // threads may call Locator() at once.
  const MeshLocator& Locator() const {
    std::call_once(made_, [this] { locator_.emplace(*scene_, mesh_); });
    return *locator_;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  IrradianceMesh mesh_;
  mutable std::once_flag made_;
  mutable std::optional<MeshLocator> locator_;
};

inline constexpr std::size_t kMeshKinds = 4;
// The name of the drawing mode that shows a kind of mesh. The switch statement has no default label, so that
// the compiler warns of kinds of meshes without a name.
inline const char* NameOf(MeshKind kind) {
  switch (kind) {
    case MeshKind::kFlat:
      return "flat";
    case MeshKind::kGouraud:
      return "gouraud";
    case MeshKind::kGouraudMesh:
      return "gouraud-mesh";
    case MeshKind::kInterpolant:
      return "interpolant";
  }
  return "";
}

struct Snapshot {
  std::uint64_t number = 0;  // the number of the snapshot; later snapshots have larger numbers
  // Which opened scene it shows; lamps that are dimmed change `scene`, but not this.
  std::uint64_t opening = 0;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const LightState> light;  // null until the solver has made links between elements
  // The meshes of the solution, indexed by MeshKind; null if a mesh has not been built. The mesh of kind
  // kFlat always exists, and has irradiance 0 until the solver has made links.
  std::array<std::shared_ptr<const MeshState>, kMeshKinds> mesh;
  std::vector<IterationReport> iterations;
  // The report on the iteration that is not complete, if there is one.
  std::optional<IterationReport> begun = {};
  std::size_t corrections = 0;
  bool converged = false;
  bool complete = false;  // true if the solver has no step left
  // The measured energy balance and errors, if the user has requested them.
  std::optional<PipelineReport> measured;

  const std::shared_ptr<const MeshState>& Mesh(MeshKind kind) const {
    return mesh[static_cast<std::size_t>(kind)];
  }
};

}  // namespace penumbra::viewer
