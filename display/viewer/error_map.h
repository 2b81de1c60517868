// display/viewer/error_map.h

#pragma once

#include <vector>

#include "display/viewer/snapshot.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// The representation error of each triangle: the largest of |shown - true| / max(true, 1 % of the mean of the
// channel), over the channels and kErrorPoints points inside that the interpolant does not pass through.
struct ErrorMap {
  std::vector<float> error;  // per triangle [1]
  double p99 = 0;            // the value that 99 % of the area does not pass
};
ErrorMap MapRepresentationError(const LightState& light, const IrradianceMesh& mesh,
                                const ExecutionContext& context);
inline constexpr int kErrorPoints = 4;

}  // namespace penumbra::viewer
