// solver/transport/links/solution.h
//
// The solution of a radiosity solver (thesis, chapter 4): quadtrees of elements, links between elements with
// their blockers, and the light of every element.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// The transport of light from a source element to a receiver element. Receiver and source of a link may be at
// any level of their quadtrees. For any two points that see each other, exactly one link in each direction
// connects elements that contain the two points.
struct Link {
  ElementId receiver = kNoElement, source = kNoElement;
  // The form factor F(receiver <- source) [1]: (mean irradiance of the receiver) / (radiosity of the source).
  double form_factor = 0;
  double variation = 0;  // root mean square deviation of the point form factors over the receiver [1]
  // share[k] = (form factor of quarter k of the source) / (form factor of the source); the sum over k is 1.
  // Weighted by the fractions share[k], a source that has children sends the radiosities of its four children
  // instead of its mean radiosity.
  std::array<float, 4> share = {0.25F, 0.25F, 0.25F, 0.25F};
  // The root mean square deviation, over the source's quarters, of (form factor of the quarter) / (area of
  // the quarter), divided by the mean of (form factor of the quarter) / (area of the quarter).
  float source_variation = 0;
  Visibility visibility = Visibility::kVisible;  // kVisible if and only if the link has no blockers
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

struct LinkSet {
  std::vector<Link> links;  // links ordered by receiver, then by source
  std::vector<PatchId> blockers;

  std::span<const PatchId> Blockers(const Link& link) const {
    return {blockers.data() + link.first_blocker, link.blocker_count};
  }
};

// A convex piece of a leaf (element without children) with its own radiosity. Leaves are cut along contacts,
// where other surfaces touch the leaf, because the irradiances on the two sides of a contact are unrelated.
// Leaves are also cut where radiosity varies and other surfaces are so close that the variation affects their
// irradiance.
struct Fragment {
  ElementId leaf = kNoElement;
  Polygon3 polygon;  // vertices of the fragment [m], counter-clockwise as seen from the patch's front
  double area = 0;   // area of the fragment [m^2]
  Rgb irradiance = Rgb::Zero(), radiosity = Rgb::Zero();  // irradiance and radiosity of the fragment [W/m^2]
};

// The fragments (convex pieces) of a leaf. REQUIRES: `fragments` is sorted by leaf.
std::span<const Fragment> FragmentsOf(std::span<const Fragment> fragments, ElementId leaf);

// The upper bound of RadiositySolution::rays_per_point.
inline constexpr std::size_t kMostRaysPerPoint = 10'000'000;

struct RadiositySolution {
  ElementForest forest;
  LinkSet links;
  // The fragments (convex pieces) of all leaves that are cut, ordered by leaf. The irradiance and the
  // radiosity of a cut leaf are the area-weighted means over its fragments (convex pieces).
  std::vector<Fragment> fragments;
  // The irradiance and the radiosity of each element [W/m^2]. Irradiance and radiosity of a parent element
  // are the area-weighted means over its children.
  std::vector<Rgb> irradiance, radiosity;
  // For each element, the root mean square deviation of the radiosities of the leaves below the element from
  // their mean [W/m^2]. In radiosity_spread, the deviation of one leaf's radiosity is the maximum over the
  // channels.
  std::vector<double> radiosity_spread;
  // The number of rays that each point casts to gather reflected light (FinalGather). If rays_per_point is 0,
  // points cast no rays, and PointIrradiance sums up the exact light of all leaves.
  std::size_t rays_per_point = 0;
  // For each element, the root mean square of radiosity_spread over its children [W/m^2]: the error that
  // remains if each child is represented by its mean radiosity.
  std::vector<double> spread_below;

  std::span<const Fragment> FragmentsOf(ElementId leaf) const {
    return penumbra::FragmentsOf(fragments, leaf);
  }

  // The radiosity of the leaf, or of the fragment of a cut leaf, that contains the point of the patch
  // [W/m^2].
  Rgb RadiosityAt(PatchId patch, const Vec3& point) const;
};

}  // namespace penumbra
