#include "solver/transport/form_factors/hemicube.h"

#include "solver/transport/form_factors/projected_form_factor.h"

namespace penumbra {
namespace {

constexpr int kHemicubeResolution = 100;  // Ashdown's

}  // namespace

std::vector<PlaneGrid> HemicubePlanes(int resolution, CellRule rule) {
  const int half = (resolution + 1) / 2, side = 2 * half;
  const auto grid = [&](const Vec3& right, const Vec3& up, const Vec3& ahead, double bottom, int rows) {
    PlaneGrid plane;
    plane.right = right;
    plane.up = up;
    plane.ahead = ahead;
    plane.low = {-1, bottom};
    plane.cell = 2.0 / side;
    plane.columns = side;
    plane.rows = rows;
    FindDeltas(&plane, rule);
    return plane;
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  return {grid(x, y, z, -1, side), grid(y, z, x, 0, half), grid(-x, z, y, 0, half), grid(-y, z, -x, 0, half),
          grid(x, z, -y, 0, half)};
}

LinkFormFactorRegistry::Method HemicubeMethod() {
  return {"hemicube",
          "drawn on the five sides of half a cube, at a few points (Cohen and Greenberg 1985)",
          {"resolution"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const ProjectedFormFactor>(
                [](int resolution) { return HemicubePlanes(resolution); }, kHemicubeResolution, options);
          }};
}

}  // namespace penumbra
