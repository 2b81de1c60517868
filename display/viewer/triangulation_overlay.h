// display/viewer/triangulation_overlay.h

#pragma once

#include <string_view>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The overlay's switch. While triangles are shown, a click selects a triangle.
inline constexpr std::string_view kTrianglesSwitch = "triangles";

// The triangles of the irradiance mesh: discontinuity edges in violet, others in green (thesis B.4.5).
OverlayRegistry::Method TriangulationOverlayMethod();

}  // namespace penumbra::viewer
