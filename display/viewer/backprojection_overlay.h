// display/viewer/backprojection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows backprojections: the visible parts of the sources as seen from a probed point (thesis
// B.4.10).
OverlayRegistry::Method BackprojectionOverlayMethod();

}  // namespace penumbra::viewer
