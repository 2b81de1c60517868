// display/viewer/element_mesh_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The elements of the global solution, down to a chosen level (thesis B.4.2).
OverlayRegistry::Method ElementMeshOverlayMethod();

}  // namespace penumbra::viewer
