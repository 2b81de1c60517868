#include "solver/transport/links/solution.h"

#include <algorithm>

namespace penumbra {

std::span<const Fragment> FragmentsOf(std::span<const Fragment> fragments, ElementId leaf) {
  const auto first = std::partition_point(fragments.begin(), fragments.end(),
                                          [&](const Fragment& fragment) { return fragment.leaf < leaf; });
  const auto last =
      std::find_if(first, fragments.end(), [&](const Fragment& fragment) { return fragment.leaf != leaf; });
  return fragments.subspan(static_cast<std::size_t>(first - fragments.begin()),
                           static_cast<std::size_t>(last - first));
}

Rgb RadiositySolution::RadiosityAt(PatchId patch, const Vec3& point) const {
  const ElementId leaf = forest.LeafAt(patch, point);
  for (const Fragment& fragment : FragmentsOf(leaf))
    if (ConvexContains(fragment.polygon, forest.scene().patches[patch].normal, point, 0))
      return fragment.radiosity;
  return radiosity[leaf];
}

}  // namespace penumbra
