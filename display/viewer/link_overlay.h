// display/viewer/link_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// Links as arrows from source to receiver, with a colour per class (thesis B.4.3).
OverlayRegistry::Method LinkOverlayMethod();

}  // namespace penumbra::viewer
