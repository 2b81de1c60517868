// display/viewer/link_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows the links between elements as arrows from source to receiver, with a different colour
// for each LinkClass (thesis B.4.3).
OverlayRegistry::Method LinkOverlayMethod();

}  // namespace penumbra::viewer
