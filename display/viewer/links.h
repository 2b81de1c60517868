// display/viewer/links.h
//
// The links that the view shows, and their colours (thesis B.4.3).

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
  kSplit,    // pink: the plane of one end intersects the other
  kPartial,  // green: something may lie between the ends
};
LinkClass ClassOf(const RadiositySolution& solution, const Link& link);
Colour ColourOf(LinkClass link_class);
const char* NameOf(LinkClass link_class);
// The name of the OverlaySwitch that shows the links of the class.
std::string SwitchOf(LinkClass link_class);

// The irradiance that the link brings to its receiver, in the largest channel [W/m^2].
double LinkIrradiance(const RadiositySolution& solution, const Link& link);

// The indices of the links to be shown according to the settings: at most settings.link_limit links, in order
// of decreasing LinkIrradiance(). If an element is selected, only those links are included that have this
// element, one of its ancestors or one of its descendants as receiver or source.
std::vector<std::uint32_t> ShownLinks(const RadiositySolution& solution, const OverlaySettings& settings,
                                      const Selection& selection);

}  // namespace penumbra::viewer
