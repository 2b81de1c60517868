// display/viewer/link_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows the links between elements as arrows from source to receiver, in a different colour
// for visible, partly visible and split pairs (LinkClass; thesis B.4.3).
OverlayRegistry::Method LinkOverlayMethod();

}  // namespace penumbra::viewer
