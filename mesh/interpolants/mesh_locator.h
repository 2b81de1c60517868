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
    // The index of the triangle that contains the point, in IrradianceMesh::triangles.
    std::uint32_t triangle = 0;
    // The barycentric coordinates of the point in the triangle: s >= 0, t >= 0, s + t <= 1.
    double s = 0, t = 0;
  };

  // A point outside all triangles of a patch counts as lying on the patch's border if its distance from the
  // border is at most kBorder * SnapDistance().
  static constexpr double kBorder = 16;

  // Scene and mesh must outlive the MeshLocator.
  MeshLocator(const Scene& scene, const IrradianceMesh& mesh);
  ~MeshLocator();
  MeshLocator(MeshLocator&&) noexcept;

  // Finds the triangle of the patch that contains the projection of the point on the patch's plane. If
  // several triangles contain the projected point, the result is the triangle in which the point's smallest
  // barycentric coordinate is largest. Among triangles in which the smallest barycentric coordinate of the
  // point is equal, the result is the triangle with the lowest index. A point outside the patch by at most
  // max(tolerance, kBorder * SnapDistance()) [m] is moved to the patch's border. For a point farther outside
  // the patch, the result of Find() is nullopt. Find() may be called from several threads at once.
  std::optional<Location> Find(PatchId patch, const Vec3& point, double tolerance = 0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The value of the mesh's interpolant at the location [W/m^2]. The value of an interpolant may be negative
// near dark places.
Rgb IrradianceAt(const IrradianceMesh& mesh, const MeshLocator::Location& at);

}  // namespace penumbra
