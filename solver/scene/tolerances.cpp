#include "solver/scene/tolerances.h"

namespace penumbra {

double SnapDistance(const Patch& patch) {
  return kSnap * Diameter(patch.Vertices()) + kSnapCoordinate * patch.extent;
}

double ContactGap(const Scene& scene) { return kContactGap * scene.Diagonal(); }

}  // namespace penumbra
