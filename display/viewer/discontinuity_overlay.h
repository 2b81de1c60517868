// display/viewer/discontinuity_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// All potential discontinuities, in violet (thesis B.4.4).
OverlayRegistry::Method DiscontinuityOverlayMethod();

}  // namespace penumbra::viewer
