// solver/transport/links/solution.h
//
// What the hierarchical solver leaves behind (thesis, chapter 4): quadtrees, links with their blockers, and
// the light on every element.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The transport from one element to another, at one level of each. For any two mutually visible points there
// is one link each way between elements that contain them.
struct Link {
  ElementId receiver = kNoElement, source = kNoElement;
  double form_factor =
      0;  // F(receiver <- source) [1]: mean irradiance of the receiver per unit radiosity of the source
  double variation = 0;  // root mean square deviation of the point form factors over the receiver [1]
  // How the form factor is shared among the source's four quarters; they add up to 1. They let a source that
  // has children shine with their radiosities, not with its mean.
  std::array<float, 4> share = {0.25F, 0.25F, 0.25F, 0.25F};
  // Root mean square deviation, relative to the mean, of the form factor per area over those quarters.
  float source_variation = 0;
  Visibility visibility = Visibility::kVisible;  // kVisible just if there are no blockers
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

struct LinkSet {
  std::vector<Link> links;  // by receiver, then by source
  std::vector<PatchId> blockers;

  std::span<const PatchId> Blockers(const Link& link) const {
    return {blockers.data() + link.first_blocker, link.blocker_count};
  }
};

// A convex piece of a leaf with a radiosity of its own. Contacts cut leaves: furniture stands on them, and
// the light on either side has nothing to do with that on the other. So does light that varies where others
// are near enough to see it.
struct Fragment {
  ElementId leaf = kNoElement;
  Polygon3 polygon;                                       // [m], counter-clockwise from the front
  double area = 0;                                        // [m^2]
  Rgb irradiance = Rgb::Zero(), radiosity = Rgb::Zero();  // [W/m^2]
};

// The fragments of a leaf, of a list that ascends by leaf.
std::span<const Fragment> FragmentsOf(std::span<const Fragment> fragments, ElementId leaf);

struct RadiositySolution {
  ElementForest forest;
  LinkSet links;
  // Of the leaves that are cut, by contacts or because light varies on them, by leaf; the leaf's light is
  // their area-weighted mean.
  std::vector<Fragment> fragments;
  // Per element [W/m^2]. A parent's is the area-weighted mean of its children's.
  std::vector<Rgb> irradiance, radiosity;
  // Per element [W/m^2]: root mean square deviation of the leaves' radiosities below it, of its largest
  // channel.
  std::vector<double> radiosity_spread;
  // The same of each child about its own mean: what the children's radiosities leave out.
  std::vector<double> spread_below;

  std::span<const Fragment> FragmentsOf(ElementId leaf) const {
    return penumbra::FragmentsOf(fragments, leaf);
  }

  // The radiosity of the leaf, or fragment, that contains a point of the patch [W/m^2].
  Rgb RadiosityAt(PatchId patch, const Vec3& point) const;
};

}  // namespace penumbra
