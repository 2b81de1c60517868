// display/viewer/sample_point_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The samples of the interpolants, yellow (thesis B.4.8).
OverlayRegistry::Method SamplePointOverlayMethod();

}  // namespace penumbra::viewer
