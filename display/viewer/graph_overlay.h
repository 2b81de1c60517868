// display/viewer/graph_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows graphs of the irradiance over triangles: exact irradiance in white, interpolated
// irradiance in blue, and their difference in red (thesis B.4.7).
OverlayRegistry::Method GraphOverlayMethod();

}  // namespace penumbra::viewer
