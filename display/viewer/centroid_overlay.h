// display/viewer/centroid_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that marks the centroids of the mesh's triangles with white crosses.
OverlayRegistry::Method CentroidOverlayMethod();

}  // namespace penumbra::viewer
