#include "display/viewer/solver_place.h"

#include <cmath>

namespace penumbra::viewer {

std::size_t BytesOf(const SolverPlace& place) {
  if (!place.snapshot->light) return 0;
  const RadiositySolution& solution = place.snapshot->light->solution();
  constexpr std::size_t kOfElement = sizeof(Element) + 2 * sizeof(Rgb) + 2 * sizeof(double);
  const std::size_t light = solution.links.links.size() * sizeof(Link) +
                            solution.links.blockers.size() * sizeof(PatchId) +
                            solution.forest.size() * kOfElement;
  std::size_t triangles = 0;
  for (const auto& mesh : place.snapshot->mesh)
    if (mesh) triangles += mesh->mesh().triangles.size();
  // The snapshot has the light once, and the pipeline again.
  return 2 * light + triangles * (sizeof(QuadraticInterpolant) + sizeof(IrradianceMesh::Triangle));
}

double ChangeOfLight(const LightState* before, const LightState& now) {
  const RadiositySolution& solution = now.solution();
  const std::vector<Patch>& patches = now.scene().patches;
  const bool comparable = before && before->scene().patches.size() == patches.size();
  double squares = 0, total = 0, area = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const Rgb was = comparable ? before->solution().irradiance[p] : Rgb(Rgb::Zero());
    const double difference = (solution.irradiance[p] - was).abs().maxCoeff();
    squares += patches[p].area * difference * difference;
    total += patches[p].area * solution.irradiance[p].maxCoeff();
    area += patches[p].area;
  }
  return total > 0 ? std::sqrt(squares / area) / (total / area) : 0;
}

}  // namespace penumbra::viewer
