// display/viewer/selection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The outline of the selection (thesis B.4.6): an element; a link; a link's tube with the blockers; a
// triangle; a discontinuity with source, blocker and receiver.
OverlayRegistry::Method SelectionOverlayMethod();

}  // namespace penumbra::viewer
