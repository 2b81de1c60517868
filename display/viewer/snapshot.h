// display/viewer/snapshot.h
//
// What the solver's thread hands to the view: states that never change once they are there, so that the view
// can draw one while the next is being worked out.

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

// The global solution at some step, with all that must live as long as it.
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
  // As the mesh of this light would look for them.
  const DiscontinuityOptions& discontinuities() const { return discontinuities_; }

  // Irradiance at points, exact; made when first asked for. Safe from any thread.
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

// A mesh of a light state.
class MeshState {
 public:
  MeshState(std::shared_ptr<const Scene> scene, IrradianceMesh mesh)
      : scene_(std::move(scene)), mesh_(std::move(mesh)) {}

  const Scene& scene() const { return *scene_; }
  const IrradianceMesh& mesh() const { return mesh_; }
  // Which triangle holds a point; made when first asked for. Safe from any thread.
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
// As modes of drawing are called. Without a default: the compiler tells which kind has no name.
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
  // By MeshKind; kFlat is always there, black before the first links.
  std::array<std::shared_ptr<const MeshState>, kMeshKinds> mesh;
  std::vector<IterationReport> iterations;
  std::size_t corrections = 0;
  bool converged = false;
  std::optional<PipelineReport> measured;  // energy and errors, once they were asked for

  const std::shared_ptr<const MeshState>& Mesh(MeshKind kind) const {
    return mesh[static_cast<std::size_t>(kind)];
  }
};

}  // namespace penumbra::viewer
