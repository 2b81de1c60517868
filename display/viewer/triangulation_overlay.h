// display/viewer/triangulation_overlay.h

#pragma once

#include <string_view>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// Its switch. With triangles shown, a click selects one.
inline constexpr std::string_view kTrianglesSwitch = "triangles";

// The triangles of the irradiance mesh: discontinuity edges violet, others green (thesis B.4.5).
OverlayRegistry::Method TriangulationOverlayMethod();

}  // namespace penumbra::viewer
