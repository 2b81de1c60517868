// display/viewer/links.h
//
// Which links are shown, and how (thesis B.4.3).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "display/viewer/overlay_drawing.h"
#include "display/viewer/view_state.h"
#include "solver/transport/links/solution.h"

namespace penumbra::viewer {

enum class LinkClass : std::uint8_t {
  kVisible,  // white
  kSplit,    // pink: the plane of one end cuts the other
  kPartial,  // green: something may stand between
};
LinkClass ClassOf(const RadiositySolution& solution, const Link& link);
Colour ColourOf(LinkClass link_class);
const char* NameOf(LinkClass link_class);
// The switch that shows links of the class.
std::string SwitchOf(LinkClass link_class);

// What the link brings its receiver, largest channel [W/m^2].
double LinkIrradiance(const RadiositySolution& solution, const Link& link);

// The indices of the links that the settings let through, at most settings.link_limit, the strongest first.
// With an element selected, only links that end at it, above it or below it.
std::vector<std::uint32_t> ShownLinks(const RadiositySolution& solution, const OverlaySettings& settings,
                                      const Selection& selection);

}  // namespace penumbra::viewer
