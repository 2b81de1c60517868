// display/viewer/overlays.h

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The registry of all overlays, in the order of menus.
OverlayRegistry& Overlays();

// One object per overlay, in the same order.
std::vector<std::unique_ptr<const Overlay>> MakeOverlays();

// What must be computed to draw all overlays that are switched on.
OverlayNeeds NeedsOf(const OverlaySettings& settings);

// The drawing of all overlays.
OverlayDrawing DrawOverlays(const OverlayContext& context);

// Adds the switches and settings of the group's overlays.
void AddOverlaySettings(std::string_view group, OverlaySettings* values, Settings* settings);

}  // namespace penumbra::viewer
