// display/viewer/backprojection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The backprojections of the sources from a probed point (thesis B.4.10).
OverlayRegistry::Method BackprojectionOverlayMethod();

}  // namespace penumbra::viewer
