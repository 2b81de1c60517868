// mesh/interpolants/mesh_locator.h
//
// Finds the triangle of an irradiance mesh that contains a point, and the point's barycentric coordinates.

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
    double s = 0, t = 0;         // coordinates of the interpolant: s, t >= 0, s + t <= 1
  };

  // A point outside all triangles of a patch counts as lying on their border if its distance from the border
  // is at most kBorder * SnapDistance().
  static constexpr double kBorder = 16;

  // Scene and mesh must outlive the locator.
  MeshLocator(const Scene& scene, const IrradianceMesh& mesh);
  ~MeshLocator();
  MeshLocator(MeshLocator&&) noexcept;

  // The triangle of the patch that contains the point's projection on the patch. If several triangles contain
  // the projection, the result is the triangle with the largest minimum barycentric coordinate; if these are
  // equal, the triangle with the lowest index. A point outside the patch by at most max(tolerance, kBorder *
  // SnapDistance()) [m] is moved to the border; for a point farther outside, the result is nullopt. May be
  // called from several threads at once.
  std::optional<Location> Find(PatchId patch, const Vec3& point, double tolerance = 0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The interpolant's value at the location [W/m^2]. The value may be negative near dark places.
Rgb IrradianceAt(const IrradianceMesh& mesh, const MeshLocator::Location& at);

}  // namespace penumbra
