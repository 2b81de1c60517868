// display/viewer/overlays.h

#pragma once

#include <memory>
#include <vector>

#include "display/viewer/overlay.h"

namespace penumbra::viewer {

// Every overlay there is, in the order of menus.
OverlayRegistry& Overlays();

// One of each, in the same order.
std::vector<std::unique_ptr<const Overlay>> MakeOverlays();

// What the switches that are on need.
OverlayNeeds NeedsOf(const OverlaySettings& settings);

// What all of them draw.
OverlayDrawing DrawOverlays(const OverlayContext& context);

// Adds the switches and settings of those that stand in the group.
void AddOverlaySettings(std::string_view group, OverlaySettings* values, Settings* settings);

}  // namespace penumbra::viewer
