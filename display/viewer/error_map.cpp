#include "display/viewer/error_map.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "display/viewer/mesh_tools.h"
#include "mesh/interpolants/representation_error.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {
namespace {

// The centroid, and a point towards each corner; none is a node of the interpolant.
constexpr std::array<std::array<double, 2>, kErrorPoints> kAt = {
    {{1.0 / 3, 1.0 / 3}, {0.15, 0.15}, {0.7, 0.15}, {0.15, 0.7}}};

}  // namespace

ErrorMap MapRepresentationError(const LightState& light, const IrradianceMesh& mesh,
                                const ExecutionContext& context) {
  const std::size_t count = mesh.triangles.size();
  std::vector<std::array<Rgb, kErrorPoints>> truth(count);
  ParallelFor(count, 8, [&](std::size_t i) {
    if (context.Cancelled()) return;
    for (std::size_t k = 0; k < kAt.size(); ++k)
      truth[i][k] = ExactInTriangle(light, mesh, static_cast<std::uint32_t>(i), kAt[k][0], kAt[k][1]);
  });
  ErrorMap map;
  if (context.Cancelled()) return map;
  std::vector<double> area(count);
  Rgb mean = Rgb::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    area[i] = TriangleArea(mesh, static_cast<std::uint32_t>(i));
    for (const Rgb& e : truth[i]) mean += area[i] / kErrorPoints * e;
  }
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  if (total > 0) mean /= total;
  map.error.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    double worst = 0;
    for (std::size_t k = 0; k < kAt.size(); ++k) {
      const Rgb shown = mesh.irradiance[i].At(kAt[k][0], kAt[k][1]).max(0.0);
      const Rgb difference = (shown - truth[i][k]).abs();
      for (int c = 0; c < 3; ++c)
        if (difference[c] > 0)
          worst = std::max(worst, difference[c] / std::max(truth[i][k][c], kErrorFloor * mean[c]));
    }
    map.error[i] = static_cast<float>(worst);
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return map.error[a] < map.error[b]; });
  double below = 0;
  for (const std::size_t i : order) {
    map.p99 = static_cast<double>(map.error[i]);
    below += area[i];
    if (below >= 0.99 * total) break;
  }
  return map;
}

}  // namespace penumbra::viewer
