#include "solver/transport/solution.h"

#include <algorithm>

namespace penumbra {

std::span<const Fragment> RadiositySolution::FragmentsOf(ElementId leaf) const {
  const auto first = std::partition_point(fragments.begin(), fragments.end(),
                                          [&](const Fragment& fragment) { return fragment.leaf < leaf; });
  const auto last =
      std::find_if(first, fragments.end(), [&](const Fragment& fragment) { return fragment.leaf != leaf; });
  return {first, last};
}

}  // namespace penumbra
