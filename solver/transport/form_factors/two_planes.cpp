#include "solver/transport/form_factors/two_planes.h"

#include <cmath>

#include "solver/transport/form_factors/projected_form_factor.h"
#include "solver/transport/form_factors/single_plane.h"

namespace penumbra {
namespace {

constexpr int kTwoPlanesResolution = 112;
constexpr int kInnerPart = 7;          // (side of the outer plane) / (side of the inner plane)
constexpr int kUnit = 2 * kInnerPart;  // the edge of the inner plane then runs between outer cells

}  // namespace

std::vector<PlaneGrid> TwoPlanes(int resolution, CellRule rule) {
  const int cells = (resolution + kUnit - 1) / kUnit * kUnit;
  PlaneGrid outer = std::move(SinglePlane(cells, rule).front());
  PlaneGrid inner = outer;
  inner.low /= kInnerPart;
  inner.cell /= kInnerPart;
  FindDeltas(&inner, rule);
  const int first = cells / 2 - cells / kUnit, end = cells / 2 + cells / kUnit;
  for (int row = first; row < end; ++row)
    for (int column = first; column < end; ++column)
      outer.delta[static_cast<std::size_t>(row) * static_cast<std::size_t>(cells) +
                  static_cast<std::size_t>(column)] = 0;
  return {std::move(inner), std::move(outer)};
}

LinkFormFactorRegistry::Method TwoPlanesMethod() {
  return {"two-planes",
          "drawn on a broad plane with a finer one inside, at a few points (Recker, George and Greenberg "
          "1990)",
          {"resolution"},
          [](const LinkFormFactorOptions& options) {
            return std::make_unique<const ProjectedFormFactor>(
                [](int resolution) { return TwoPlanes(resolution); }, kTwoPlanesResolution, options);
          }};
}

}  // namespace penumbra
