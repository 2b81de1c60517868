// solver/transport/links/push_pull.h
//
// Gathering over links and push-pull through the quadtrees (thesis 4.3; Hanrahan, Salzman and Aupperle 1991):
// one application of the transport that a solution's links stand for.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/transport/links/solution.h"

namespace penumbra {

// In which order a sweep updates the elements.
enum class IterationScheme : std::uint8_t {
  kJacobi,       // all from the light before the sweep (the thesis)
  kGaussSeidel,  // patch by patch in their order, each from the light as it is then
};

class PushPull {
 public:
  // Works on the light of the solution, which must outlive it.
  explicit PushPull(RadiositySolution& solution);

  // To be called when links or elements have changed: indexes them, and gives new elements the light of their
  // parents. Links are out of balance again.
  void Update();

  // From here on what the links bring to a leaf is scaled so that unit radiosity everywhere brings it as much
  // as is said, by leaf in the order of leaves() [1].
  void Balance(std::span<const double> closure);
  bool IsBalanced() const { return !scale_.empty(); }

  // The links of a receiver, as indices into the solution's.
  std::size_t FirstLink(ElementId receiver) const { return first_link_[static_cast<std::size_t>(receiver)]; }
  std::size_t EndLink(ElementId receiver) const {
    return first_link_[static_cast<std::size_t>(receiver) + 1];
  }

  // The leaves, patch by patch, in the order in which they came into being.
  std::span<const ElementId> leaves() const { return leaves_; }

  // One sweep: leaves get what the links bring and their `correction` (by element, or empty) [W/m^2], and
  // reflect it. Returns the largest change of a leaf's radiosity, by channel [W/m^2].
  Rgb Sweep(IterationScheme scheme, std::span<const Rgb> correction);

  // Gives a leaf its irradiance, and the radiosity that follows.
  void Light(ElementId leaf, const Rgb& irradiance);
  // The area-weighted means of what is below, for all elements.
  void Pull();
  // How much leaves vary below each element: RadiositySolution's spreads.
  void UpdateSpreads();

  // What the links make of any radiosities, given for all elements: the irradiance of all elements, which may
  // be negative if the radiosities are.
  std::vector<Rgb> Transport(std::span<const Rgb> radiosity) const;

  // The largest radiosity less emittance of any leaf and channel [W/m^2].
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
  std::vector<std::size_t> first_link_;      // per element
  std::vector<std::size_t> first_of_patch_;  // per patch, into order_
  std::vector<ElementId> order_;             // patch by patch, parents before their children
  std::vector<ElementId> leaves_;
  std::vector<double> scale_;  // per element, of leaves, by which links bring more than they say; or empty
};

}  // namespace penumbra
