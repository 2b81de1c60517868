#include "solver/transport/form_factors/cubic_tetrahedron.h"

#include <array>
#include <cmath>

#include "solver/transport/form_factors/projected_form_factor.h"

namespace penumbra {
namespace {

constexpr int kTetrahedronResolution = 142;  // Ashdown's

}  // namespace

std::vector<PlaneGrid> CubicTetrahedronPlanes(int resolution, CellRule rule) {
  // The edges of the cube's corner: orthonormal, all at the same height above the horizon.
  const double flat = std::sqrt(2.0 / 3), height = 1 / std::sqrt(3.0);
  const std::array<Vec3, 3> edge = {Vec3(flat, 0, height), Vec3(-flat / 2, flat * std::sqrt(3.0) / 2, height),
                                    Vec3(-flat / 2, -flat * std::sqrt(3.0) / 2, height)};
  std::vector<PlaneGrid> planes;
  for (std::size_t i = 0; i < 3; ++i) {
    PlaneGrid plane;
    plane.ahead = edge[i];
    plane.right = edge[(i + 1) % 3];
    plane.up = edge[(i + 2) % 3];
    plane.low = {-2, -2};
    plane.cell = 3.0 / resolution;
    plane.columns = plane.rows = resolution;
    plane.halved = true;
    FindDeltas(&plane, rule);
    planes.push_back(std::move(plane));
  }
  return planes;
}

LinkFormFactorRegistry::Method CubicTetrahedronMethod() {
  return {"cubic-tetrahedron",
          "drawn on the three faces of a cube's corner, at a few points (Beran-Koehn and Pavicic 1991)",
          {"resolution"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const ProjectedFormFactor>(
                [](int resolution) { return CubicTetrahedronPlanes(resolution); }, kTetrahedronResolution,
                options);
          }};
}

}  // namespace penumbra
