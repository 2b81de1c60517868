// solver/transport/links/push_pull.h
//
// Gathering over links and push-pull through the quadtrees (thesis 4.3; Hanrahan, Salzman and Aupperle 1991):
// one application of the transport operator of a solution's links.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"

namespace penumbra {

// The order in which a sweep updates the elements.
enum class IterationScheme : std::uint8_t {
  kJacobi,       // all elements from the light before the sweep (the thesis)
  kGaussSeidel,  // patch after patch, each from the newest light
};

class PushPull {
 public:
  // The object reads and changes the irradiances and radiosities of `solution`, which must outlive the
  // object.
  explicit PushPull(RadiositySolution& solution);

  // Must be called after links or elements have changed. Rebuilds the index of links, gives new elements the
  // light of their parents, and undoes Balance().
  void Update();

  // Scales the light that links bring to each leaf, such that unit radiosity of all elements gives leaf
  // leaves()[i] the irradiance closure[i] [1].
  void Balance(std::span<const double> closure);
  bool IsBalanced() const { return !scale_.empty(); }

  // The links of a receiver are links[FirstLink(receiver)] to links[EndLink(receiver) - 1] of the solution.
  std::size_t FirstLink(ElementId receiver) const { return first_link_[static_cast<std::size_t>(receiver)]; }
  std::size_t EndLink(ElementId receiver) const {
    return first_link_[static_cast<std::size_t>(receiver) + 1];
  }

  // The leaves, patch by patch, in the order of their creation.
  std::span<const ElementId> leaves() const { return leaves_; }

  // One sweep: sets the irradiance of each leaf to the light of its links plus correction[leaf] [W/m^2], and
  // updates the leaf's radiosity. `correction` is indexed by ElementId, or empty. Returns the largest change
  // of a leaf's radiosity for each channel [W/m^2].
  Rgb Sweep(IterationScheme scheme, std::span<const Rgb> correction);

  // Sets the irradiance of a leaf [W/m^2] and the resulting radiosity.
  void Light(ElementId leaf, const Rgb& irradiance);
  // Sets the light of every parent to the area-weighted mean of its children.
  void Pull();
  // Computes RadiositySolution::radiosity_spread and spread_below.
  void UpdateSpreads();

  // The irradiance [W/m^2] that all elements receive over the links if the elements have the given
  // radiosities. Negative radiosities may give negative irradiance.
  std::vector<Rgb> Transport(std::span<const Rgb> radiosity) const;

  // The largest reflected radiosity, radiosity - emittance, over all leaves and channels [W/m^2].
  double LargestReflected() const;

 private:
  std::span<const ElementId> ElementsOf(std::size_t patch) const {
    return {order_.data() + first_of_patch_[patch], order_.data() + first_of_patch_[patch + 1]};
  }
  Rgb Gathered(ElementId receiver, std::span<const Rgb> radiosity) const;
  void Push(std::size_t patch, std::span<Rgb> irradiance) const;
  template <class Value>
  void Average(std::size_t patch, std::vector<Value>& values) const;
  Rgb LightPatch(std::size_t patch, std::span<Rgb> pushed, std::span<const Rgb> correction);

  RadiositySolution& solution_;
  std::vector<std::size_t> first_link_;      // of each element
  std::vector<std::size_t> first_of_patch_;  // of each patch, in order_
  std::vector<ElementId> order_;             // patch by patch, parents before children
  std::vector<ElementId> leaves_;
  std::vector<double> scale_;  // by element: the factor on the links' light, for leaves; or empty
};

// Sets the irradiance of all leaves, from `element`, which is indexed by ElementId, and of all fragments
// [W/m^2], and the radiosities and spreads that follow from them. No light is reflected any further.
// REQUIRES: there is one value for each element and each fragment.
void ReplaceIrradiance(std::span<const Rgb> element, std::span<const Rgb> fragment,
                       RadiositySolution& solution);

}  // namespace penumbra
