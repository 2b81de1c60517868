#include "display/viewer/links.h"

#include <algorithm>
#include <array>

#include "display/viewer/mesh_tools.h"

namespace penumbra::viewer {
namespace {

// Whether the plane of `plane` has vertices of the element well on both of its sides.
bool Splits(const ElementForest& forest, ElementId plane, ElementId element) {
  const Patch& patch = forest.scene().patches[static_cast<std::size_t>(forest[plane].patch)];
  const double rounding = 1e-9 * (patch.extent + 1);  // far above that of the heights, far below what is seen
  bool above = false, below = false;
  for (const Vec3& v : forest[element].Vertices()) {
    const double height = patch.normal.dot(v - patch.vertex[0]);
    above |= height > rounding;
    below |= height < -rounding;
  }
  return above && below;
}

}  // namespace

LinkClass ClassOf(const RadiositySolution& solution, const Link& link) {
  if (Splits(solution.forest, link.source, link.receiver) ||
      Splits(solution.forest, link.receiver, link.source))
    return LinkClass::kSplit;
  return link.visibility == Visibility::kVisible ? LinkClass::kVisible : LinkClass::kPartial;
}

Colour ColourOf(LinkClass link_class) {
  switch (link_class) {
    case LinkClass::kVisible:
      return colour::kWhite;
    case LinkClass::kSplit:
      return colour::kPink;
    case LinkClass::kPartial:
      break;
  }
  return colour::kGreen;
}

const char* NameOf(LinkClass link_class) {
  switch (link_class) {
    case LinkClass::kVisible:
      return "visible";
    case LinkClass::kSplit:
      return "split by a plane";
    case LinkClass::kPartial:
      break;
  }
  return "partial";
}

std::string SwitchOf(LinkClass link_class) {
  switch (link_class) {
    case LinkClass::kVisible:
      return "visible-links";
    case LinkClass::kSplit:
      return "split-links";
    case LinkClass::kPartial:
      break;
  }
  return "partial-links";
}

double LinkIrradiance(const RadiositySolution& solution, const Link& link) {
  return link.form_factor * solution.radiosity[static_cast<std::size_t>(link.source)].maxCoeff();
}

std::vector<std::uint32_t> ShownLinks(const RadiositySolution& solution, const OverlaySettings& settings,
                                      const Selection& selection) {
  const ElementForest& forest = solution.forest;
  const std::vector<Link>& links = solution.links.links;
  std::vector<std::pair<double, std::uint32_t>> shown;
  std::array<bool, 3> class_shown;
  for (const LinkClass link_class : {LinkClass::kVisible, LinkClass::kSplit, LinkClass::kPartial})
    class_shown[static_cast<std::size_t>(link_class)] = settings.Shows(SwitchOf(link_class));
  const auto touches = [&](ElementId element, ElementId top) {
    return IsBelow(forest, element, top) || IsBelow(forest, top, element);
  };
  for (std::uint32_t i = 0; i < links.size(); ++i) {
    const Link& link = links[i];
    if (selection.kind == SelectionKind::kElement) {
      const auto top = static_cast<ElementId>(selection.index);
      if (!touches(link.receiver, top) && !touches(link.source, top)) continue;
    }
    const double strength = LinkIrradiance(solution, link);
    if (strength < settings.link_min_irradiance) continue;
    if (!class_shown[static_cast<std::size_t>(ClassOf(solution, link))]) continue;
    shown.emplace_back(-strength, i);
  }
  const std::size_t count =
      std::min(shown.size(), static_cast<std::size_t>(std::max(settings.link_limit, 0)));
  std::partial_sort(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(count), shown.end());
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i < count; ++i) indices.push_back(shown[i].second);
  return indices;
}

}  // namespace penumbra::viewer
