// display/viewer/error_map.h

#pragma once

#include <vector>

#include "display/viewer/snapshot.h"
#include "solver/base/progress.h"

namespace penumbra::viewer {

// The representation error of each triangle of the mesh: the maximum of |shown - true| / max(true, 1 % of the
// channel's mean), where `shown` is the interpolated and `true` the exact irradiance. The maximum error of a
// triangle is taken over the channels and over kErrorPoints interior points that are not nodes of the
// interpolant.
struct ErrorMap {
  std::vector<float> error;  // relative error of the interpolant of each triangle
  double p99 = 0;            // representation error that 99 % of the mesh's area does not exceed
};
ErrorMap MapRepresentationError(const LightState& light, const IrradianceMesh& mesh,
                                const ExecutionContext& context);
inline constexpr int kErrorPoints = 4;

}  // namespace penumbra::viewer
