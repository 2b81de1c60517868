// solver/transport/links/solution.h
//
// The result of the hierarchical solver (thesis, chapter 4): quadtrees, links with their blockers, and the
// light of every element.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The transport from a source element to a receiver element, at one level of both trees. Any two points that
// see each other have exactly one link in each direction between elements that contain them.
struct Link {
  ElementId receiver = kNoElement, source = kNoElement;
  double form_factor =
      0;  // F(receiver <- source) [1]: mean irradiance of the receiver per unit radiosity of the source
  double variation = 0;  // root mean square deviation of the point form factors over the receiver [1]
  // share[k]: form factor of quarter k of the source / form factor of the source; the sum is 1. The shares
  // let a source with children send the radiosities of its children instead of its mean.
  std::array<float, 4> share = {0.25F, 0.25F, 0.25F, 0.25F};
  // Root mean square deviation of form factor / area over the source's quarters, relative to the mean.
  float source_variation = 0;
  Visibility visibility = Visibility::kVisible;  // kVisible if and only if there are no blockers
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

struct LinkSet {
  std::vector<Link> links;  // ordered by receiver, then by source
  std::vector<PatchId> blockers;

  std::span<const PatchId> Blockers(const Link& link) const {
    return {blockers.data() + link.first_blocker, link.blocker_count};
  }
};

// A convex piece of a leaf with its own radiosity. Leaves are cut along contacts, since the light on the two
// sides of furniture is unrelated, and where light varies and other surfaces are close enough to see the
// variation.
struct Fragment {
  ElementId leaf = kNoElement;
  Polygon3 polygon;                                       // [m], counter-clockwise from the front
  double area = 0;                                        // [m^2]
  Rgb irradiance = Rgb::Zero(), radiosity = Rgb::Zero();  // [W/m^2]
};

// The fragments of a leaf. REQUIRES: `fragments` ascends by leaf.
std::span<const Fragment> FragmentsOf(std::span<const Fragment> fragments, ElementId leaf);

struct RadiositySolution {
  ElementForest forest;
  LinkSet links;
  // The fragments of all leaves that are cut, ordered by leaf. The light of such a leaf is the area-weighted
  // mean of its fragments.
  std::vector<Fragment> fragments;
  // By element [W/m^2]. The value of a parent is the area-weighted mean of its children's values.
  std::vector<Rgb> irradiance, radiosity;
  // By element [W/m^2]: the root mean square deviation of the radiosities of the leaves below from the mean;
  // a deviation is that of the largest channel.
  std::vector<double> radiosity_spread;
  // By element [W/m^2]: the root mean square of the children's spreads, each about its own mean; the
  // variation that the children's radiosities do not show.
  std::vector<double> spread_below;

  std::span<const Fragment> FragmentsOf(ElementId leaf) const {
    return penumbra::FragmentsOf(fragments, leaf);
  }

  // The radiosity at a point of the patch: that of the leaf or fragment that contains the point [W/m^2].
  Rgb RadiosityAt(PatchId patch, const Vec3& point) const;
};

}  // namespace penumbra
