#include "solver/transport/links/refinement_oracle.h"

namespace penumbra {

bool MaySplit(const Element& element, double min_area) {
  return element.area >= 4 * min_area && element.level < kMaxLevel;
}

}  // namespace penumbra
