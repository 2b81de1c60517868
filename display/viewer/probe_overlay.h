// display/viewer/probe_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows the irradiance at a probed point as the length of a white stick (thesis B.4.9).
OverlayRegistry::Method ProbeOverlayMethod();

}  // namespace penumbra::viewer
