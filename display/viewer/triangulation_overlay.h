// display/viewer/triangulation_overlay.h

#pragma once

#include <string_view>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The name of the overlay switch that shows the triangles of the mesh. While the triangles of the mesh are
// shown, a click selects a triangle.
inline constexpr std::string_view kTrianglesSwitch = "triangles";

// An overlay that shows the triangles of the irradiance mesh, with edges on discontinuities in violet and all
// other edges in green (thesis B.4.5).
OverlayRegistry::Method TriangulationOverlayMethod();

}  // namespace penumbra::viewer
