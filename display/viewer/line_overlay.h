// display/viewer/line_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The line whose light is plotted.
OverlayRegistry::Method LineOverlayMethod();

}  // namespace penumbra::viewer
