// display/viewer/overlays.h

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The registry of all overlays, in the order in which menus list the overlays.
OverlayRegistry& Overlays();

// Makes one object of each overlay, in the order of Overlays().
std::vector<std::unique_ptr<const Overlay>> MakeOverlays();

// The results that all overlays that are switched on need together.
OverlayNeeds NeedsOf(const OverlaySettings& settings);

// Draws all overlays into one OverlayDrawing.
OverlayDrawing DrawOverlays(const OverlayContext& context);

// Adds the switches and settings of all overlays of a group (panel name in kOverlayGroups) to `settings`.
void AddOverlaySettings(std::string_view group, OverlaySettings* values, Settings* settings);

}  // namespace penumbra::viewer
