#include "solver/transport/links/fragment_locator.h"

#include <algorithm>
#include <limits>

namespace penumbra {

FragmentLocator::FragmentLocator(const RadiositySolution& solution) {
  if (solution.fragments.empty()) return;
  first_.assign(solution.forest.size() + 1, 0);
  for (const Fragment& fragment : solution.fragments) ++first_[static_cast<std::size_t>(fragment.leaf) + 1];
  for (std::size_t e = 0; e < solution.forest.size(); ++e) first_[e + 1] += first_[e];
  for (const Fragment& fragment : solution.fragments) {
    const PatchId patch = solution.forest[fragment.leaf].patch;
    const Vec3& normal = solution.forest.scene().patches[static_cast<std::size_t>(patch)].normal;
    first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
    for (std::size_t k = 0; k < fragment.polygon.size(); ++k) {
      const Vec3 &a = fragment.polygon[k], &b = fragment.polygon[(k + 1) % fragment.polygon.size()];
      const Vec3 inward = normal.cross(b - a).normalized();
      edges_.push_back({inward, inward.dot(a)});
    }
  }
  first_edge_.push_back(static_cast<std::uint32_t>(edges_.size()));
}

std::int32_t FragmentLocator::Find(ElementId leaf, const Vec3& point) const {
  std::int32_t best = FirstOf(leaf);
  double deepest = -std::numeric_limits<double>::infinity();
  for (std::int32_t f = FirstOf(leaf); f < FirstOf(leaf + 1); ++f) {
    double depth = std::numeric_limits<double>::infinity();
    for (std::uint32_t e = first_edge_[static_cast<std::size_t>(f)];
         e < first_edge_[static_cast<std::size_t>(f) + 1]; ++e)
      depth = std::min(depth, edges_[e].inward.dot(point) - edges_[e].offset);
    if (depth <= deepest) continue;
    deepest = depth;
    best = f;
  }
  return best;
}

}  // namespace penumbra
