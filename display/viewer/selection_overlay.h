// display/viewer/selection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// Draws the selected object (thesis B.4.6): the outline of an element or triangle; a link; the tube of a
// link, with the blockers; or a discontinuity with its source, blocker and receiver.
OverlayRegistry::Method SelectionOverlayMethod();

}  // namespace penumbra::viewer
