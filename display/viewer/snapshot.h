// display/viewer/snapshot.h
//
// States that the solver's thread passes to the view. A state never changes, so that the view can draw one
// state while the solver computes the next.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "mesh/interpolants/irradiance_mesh.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/scene/scene.h"
#include "solver/transport/links/solution.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra::viewer {

// The global solution after some step, together with the objects that must live as long.
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
  // The options of the discontinuities for a mesh of this light.
  const DiscontinuityOptions& discontinuities() const { return discontinuities_; }

  // Exact irradiance at points; created by the first call. Safe from any thread.
  const PointIrradiance& Exact() const {
    std::call_once(made_, [this] { exact_.emplace(solution_, *visibility_, options_); });
    return *exact_;
  }

 private:
  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const PatchVisibility> visibility_;
  RadiositySolution solution_;
  PointIrradianceOptions options_;
  DiscontinuityOptions discontinuities_;
  mutable std::once_flag made_;
  mutable std::optional<PointIrradiance> exact_;
};

// A mesh of a LightState.
class MeshState {
 public:
  MeshState(std::shared_ptr<const Scene> scene, IrradianceMesh mesh)
      : scene_(std::move(scene)), mesh_(std::move(mesh)) {}

  const Scene& scene() const { return *scene_; }
  const IrradianceMesh& mesh() const { return mesh_; }
  // Finds the triangle at a point; created by the first call. Safe from any thread.
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
// The names of the drawing modes. The switch has no default, so that the compiler reports kinds without a
// name.
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
  std::uint64_t number = 0;  // ascending
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const LightState> light;  // null before the first links
  // Indexed by MeshKind. kFlat always exists, and is black before the first links.
  std::array<std::shared_ptr<const MeshState>, kMeshKinds> mesh;
  std::vector<IterationReport> iterations;
  std::size_t corrections = 0;
  bool converged = false;
  std::optional<PipelineReport> measured;  // energy and errors, after a request

  const std::shared_ptr<const MeshState>& Mesh(MeshKind kind) const {
    return mesh[static_cast<std::size_t>(kind)];
  }
};

}  // namespace penumbra::viewer
