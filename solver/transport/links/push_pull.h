// solver/transport/links/push_pull.h
//
// Gathering light over links and push-pull through the quadtrees (thesis 4.3; Hanrahan, Salzman and Aupperle
// 1991). A gather with push-pull applies the light transport operator of the links once.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"

namespace penumbra {

// The order in which a sweep (a gather over all links) updates the elements.
enum class IterationScheme : std::uint8_t {
  kJacobi,       // all elements gather radiosities as they were before the sweep (as in the thesis)
  kGaussSeidel,  // the elements of one patch after another gather the newest radiosities
};

class PushPull {
 public:
  // The PushPull reads and changes the irradiances and radiosities of `solution`, which must outlive the
  // PushPull.
  explicit PushPull(RadiositySolution& solution);

  // Update() must be called after links or elements have changed. Update() rebuilds the index of links, gives
  // new elements the light of their parents, and removes the scale factors of Balance().
  void Update();

  // Scales the light that links bring to each leaf. After Balance(), the irradiance of the leaf leaves()[i]
  // is closure[i] if all elements have radiosity 1.
  void Balance(std::span<const double> closure);
  bool IsBalanced() const { return !scale_.empty(); }

  // The links of a receiver are links[FirstLink(receiver)] to links[EndLink(receiver) - 1] of the solution.
  std::size_t FirstLink(ElementId receiver) const { return first_link_[static_cast<std::size_t>(receiver)]; }
  std::size_t EndLink(ElementId receiver) const {
    return first_link_[static_cast<std::size_t>(receiver) + 1];
  }

  // All leaves (elements without children), patch by patch, in the order of their creation.
  std::span<const ElementId> leaves() const { return leaves_; }

  // Makes one sweep: sets the irradiance of each leaf to (irradiance from the links) + correction[leaf]
  // [W/m^2], and updates the leaf's radiosity. `correction` is indexed by ElementId, or empty. Sweep()
  // returns the largest change of a leaf's radiosity for each channel [W/m^2].
  Rgb Sweep(IterationScheme scheme, std::span<const Rgb> correction);

  // Sets the irradiance of a leaf [W/m^2] and the resulting radiosity.
  void Light(ElementId leaf, const Rgb& irradiance);
  // Sets irradiance and radiosity of every parent element to the area-weighted means over its children.
  void Pull();
  // Computes RadiositySolution::radiosity_spread and spread_below of all elements.
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
  std::vector<std::size_t> first_link_;  // index of each element's first link, in the links of the solution
  std::vector<std::size_t> first_of_patch_;  // index of each patch's first element in order_
  std::vector<ElementId> order_;             // all elements, patch by patch, parents before children
  std::vector<ElementId> leaves_;
  // The factor by which Balance() scales the irradiance that links bring to each leaf, indexed by ElementId;
  // empty if no light is scaled.
  std::vector<double> scale_;
};

// Sets the irradiance of all leaves and of all fragments (parts of cut leaves) [W/m^2], and computes the
// resulting radiosities and RadiositySolution::radiosity_spread. ReplaceIrradiance() adds no light by further
// reflections. REQUIRES: `element` has one value for each ElementId, and `fragment` one value for each
// fragment.
void ReplaceIrradiance(std::span<const Rgb> element, std::span<const Rgb> fragment,
                       RadiositySolution& solution);

}  // namespace penumbra
