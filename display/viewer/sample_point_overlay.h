// display/viewer/sample_point_overlay.h

#pragma once

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// An overlay that shows the sample points of the irradiance interpolants, in yellow (thesis B.4.8).
OverlayRegistry::Method SamplePointOverlayMethod();

}  // namespace penumbra::viewer
