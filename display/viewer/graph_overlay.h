// display/viewer/graph_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// Graphs of the irradiance over triangles: analytic white, interpolated blue, their difference red (thesis
// B.4.7).
OverlayRegistry::Method GraphOverlayMethod();

}  // namespace penumbra::viewer
