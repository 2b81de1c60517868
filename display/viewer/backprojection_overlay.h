// display/viewer/backprojection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// What the sources look like from a probed point (thesis B.4.10).
OverlayRegistry::Method BackprojectionOverlayMethod();

}  // namespace penumbra::viewer
