// display/viewer/element_mesh_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows the quadtree elements of the radiosity solution, down to a chosen level (thesis
// B.4.2).
OverlayRegistry::Method ElementMeshOverlayMethod();

}  // namespace penumbra::viewer
