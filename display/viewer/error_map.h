// display/viewer/error_map.h

#pragma once

#include <vector>

#include "display/viewer/snapshot.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// The representation error of each triangle: the maximum of |shown - true| / max(true, 1 % of the channel's
// mean), over the channels and over kErrorPoints interior points that are not nodes of the interpolant.
struct ErrorMap {
  std::vector<float> error;  // per triangle [1]
  double p99 = 0;            // 99 % of the area has an error of at most this
};
ErrorMap MapRepresentationError(const LightState& light, const IrradianceMesh& mesh,
                                const ExecutionContext& context);
inline constexpr int kErrorPoints = 4;

}  // namespace penumbra::viewer
