// display/viewer/links.h
//
// The links between elements that the view shows, and the colours of links (thesis B.4.3).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "display/viewer/overlay_drawing.h"
#include "display/viewer/view_state.h"
#include "solver/transport/links/solution.h"

namespace penumbra::viewer {

enum class LinkClass : std::uint8_t {
  kVisible,  // white: nothing lies between source and receiver
  kSplit,    // pink: the plane of the source intersects the receiver, or the reverse
  kPartial,  // green: blockers may lie between source and receiver
};
LinkClass ClassOf(const RadiositySolution& solution, const Link& link);
Colour ColourOf(LinkClass link_class);
const char* NameOf(LinkClass link_class);
// The name of the OverlaySwitch that shows the links of a LinkClass.
std::string SwitchOf(LinkClass link_class);

// The irradiance that a link brings to its receiver element, in the largest channel [W/m^2].
double LinkIrradiance(const RadiositySolution& solution, const Link& link);

// The indices of the links to be shown: at most settings.link_limit links, in order of decreasing
// LinkIrradiance(). If an element is selected, only links of the selected element, of its ancestors and of
// its descendants are shown.
std::vector<std::uint32_t> ShownLinks(const RadiositySolution& solution, const OverlaySettings& settings,
                                      const Selection& selection);

}  // namespace penumbra::viewer
