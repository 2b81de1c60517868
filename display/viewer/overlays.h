// display/viewer/overlays.h

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// The registry of all overlays, in the order of menus.
OverlayRegistry& Overlays();

// Makes one object of each overlay, in the order of Overlays().
std::vector<std::unique_ptr<const Overlay>> MakeOverlays();

// The union of the needs of all overlays that are switched on.
OverlayNeeds NeedsOf(const OverlaySettings& settings);

// The drawing of all overlays.
OverlayDrawing DrawOverlays(const OverlayContext& context);

// Adds the switches and settings of all overlays of the group to `settings`.
void AddOverlaySettings(std::string_view group, OverlaySettings* values, Settings* settings);

}  // namespace penumbra::viewer
