// mesh/interpolants/mesh_locator.h
//
// Which triangle of an irradiance mesh holds a point, and where in it.

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "mesh/interpolants/irradiance_mesh.h"
#include "solver/scene/scene.h"

namespace penumbra {

class MeshLocator {
 public:
  struct Location {
    std::uint32_t triangle = 0;  // in IrradianceMesh::triangles
    double s = 0, t = 0;         // barycentric, as the interpolant wants them: s, t >= 0, s + t <= 1
  };

  // How far outside a patch's triangles a point may lie to be on its border, in units of SnapDistance().
  static constexpr double kBorder = 16;

  // Both must outlive the locator.
  MeshLocator(const Scene& scene, const IrradianceMesh& mesh);
  ~MeshLocator();
  MeshLocator(MeshLocator&&) noexcept;

  // The triangle of the patch that holds the point, whose height above the patch does not matter. Of several
  // the one in which it lies deepest, then the lowest index. Nothing if the point lies outside the patch by
  // more than max(tolerance, kBorder * SnapDistance()) [m]; within that it is moved to the border. Safe from
  // any thread.
  std::optional<Location> Find(PatchId patch, const Vec3& point, double tolerance = 0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The interpolant's value there [W/m^2]; it may dip below zero beside a dark place.
Rgb IrradianceAt(const IrradianceMesh& mesh, const MeshLocator::Location& at);

}  // namespace penumbra
