#include "solver/transport/points/free_area.h"

#include <span>
#include <utility>

#include "solver/base/parallel.h"
#include "solver/transport/points/point_irradiance.h"
#include "solver/transport/sources/leaf_fragments.h"
#include "solver/transport/sources/source_set.h"

namespace penumbra {
namespace {

// A part is free if fronts fill more than this fraction of its hemisphere. Gaps of ContactGap(), 1e-6 of the
// scene, let in less light, under objects as small as a hundredth of the scene.
constexpr double kThroughGaps = 1e-4;

}  // namespace

std::vector<double> FreeAreas(const Scene& scene, const ExecutionContext& context) {
  // All fronts have unit radiosity, so irradiance is the fraction of the hemisphere that fronts fill.
  Scene bright = scene;
  for (Material& material : bright.materials) material.emittance = Rgb::Ones();
  const PatchVisibility unused;
  const PointIrradiance seen(bright, unused, SourceSet::Emitters(bright));
  const std::vector<Fragment> parts = CutLeavesAtContacts(ElementForest(scene), context);
  std::vector<double> area(scene.patches.size());
  ParallelFor(area.size(), 1, [&](std::size_t p) {
    if (context.Cancelled()) return;
    const Patch& patch = scene.patches[p];
    const auto is_free = [&](std::span<const Vec3> part) {
      ReceiverPoint at;
      at.position = Centroid(part);
      at.normal = patch.normal;
      return seen.Anywhere(at).irradiance[0] > kThroughGaps;
    };
    const std::span<const Fragment> own = FragmentsOf(parts, ElementForest::Root(static_cast<PatchId>(p)));
    if (own.empty()) area[p] = is_free(patch.Vertices()) ? patch.area : 0;
    for (const Fragment& part : own)
      if (is_free(part.polygon)) area[p] += part.area;
  });
  return area;
}

}  // namespace penumbra
