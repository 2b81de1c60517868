#include "solver/transport/solvers/closure.h"

#include "solver/base/parallel.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/leaf_fragments.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {
namespace {

constexpr std::size_t kLeafGrain = 8;

}  // namespace

std::vector<double> LeafClosures(const ElementForest& forest, const PatchVisibility& visibility,
                                 std::span<const ElementId> leaves, const ExecutionContext& context) {
  // All fronts have unit radiosity, so irradiance is the fraction of the hemisphere that fronts fill.
  Scene bright = forest.scene();
  for (Material& material : bright.materials) material.emittance = Rgb::Ones();
  const PointIrradiance seen(bright, visibility, SourceSet::Emitters(bright));
  const std::vector<Fragment> parts = CutLeavesAtContacts(forest, context);
  std::vector<double> closure(leaves.size(), 0);
  ParallelFor(leaves.size(), kLeafGrain, [&](std::size_t i) {
    if (context.Cancelled()) return;
    const Element& element = forest[leaves[i]];
    const auto at = [&](std::span<const Vec3> part) {
      ReceiverPoint point;
      point.position = Centroid(part);
      point.normal = bright.patches[static_cast<std::size_t>(element.patch)].normal;
      return seen.OnPatch(element.patch, point).irradiance[0];
    };
    const std::span<const Fragment> own = FragmentsOf(parts, leaves[i]);
    if (own.empty()) {
      closure[i] = at(element.Vertices());
      return;
    }
    double area = 0;
    for (const Fragment& part : own) {
      closure[i] += part.area * at(part.polygon);
      area += part.area;
    }
    closure[i] /= area;
  });
  return closure;
}

}  // namespace penumbra
