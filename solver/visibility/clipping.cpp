#include "solver/visibility/clipping.h"

#include <vector>

#include "solver/visibility/form_factor.h"

namespace penumbra {

double Clipping::VisibleFormFactor(const DirectionPolygon& source, std::span<const Occluder> occluders,
                                   const Vec3& normal) const {
  thread_local std::vector<DirectionPolygon> pieces;
  pieces.assign(1, source);
  for (const Occluder& occluder : occluders) {
    if (pieces.empty()) break;
    Subtract(occluder, pieces);
  }
  double factor = 0;
  for (const DirectionPolygon& piece : pieces) factor += FormFactor(piece, normal);
  return factor;
}

}  // namespace penumbra
