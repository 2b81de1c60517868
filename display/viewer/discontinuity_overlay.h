// display/viewer/discontinuity_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows all potential discontinuities of the irradiance (shadow lines), in violet (thesis
// B.4.4).
OverlayRegistry::Method DiscontinuityOverlayMethod();

}  // namespace penumbra::viewer
