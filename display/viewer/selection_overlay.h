// display/viewer/selection_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that draws the selected object (thesis B.4.6). The selected object is an element, a triangle, a
// link, the tube of a link with its blockers, or a discontinuity with its source, blocker and receiver.
OverlayRegistry::Method SelectionOverlayMethod();

}  // namespace penumbra::viewer
