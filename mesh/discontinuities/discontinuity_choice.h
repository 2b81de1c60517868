// mesh/discontinuities/discontinuity_choice.h
//
// The interface of methods that choose which discontinuities become edges of the mesh.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "mesh/discontinuities/discontinuity.h"
#include "mesh/discontinuities/mesh_options.h"
#include "solver/base/registry.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

// True if the discontinuity may become an edge of the leaf. No method calls the filter for contacts.
using LeafFilter = std::function<bool(const Discontinuity&, ElementId)>;

// The order in which the discontinuities of a patch are activated.
struct DiscontinuityRanks {
  std::vector<double> rank;  // of each discontinuity; the highest comes first
  double least = 0;          // the activation omits lower ranks
};

// A method of choice. The defaults choose by weight (ActivateDiscontinuities).
class DiscontinuityChoiceMethod {
 public:
  virtual ~DiscontinuityChoiceMethod() = default;

  // True if the method makes any discontinuity an edge. If false, the mesh needs no search for
  // discontinuities.
  virtual bool TakesAny() const { return true; }

  // True if only the weights decide, so that refinement may request a discontinuity of too little weight.
  virtual bool ByWeightAlone() const { return false; }

  // The largest number of lines through the interior of a leaf.
  virtual std::size_t MostLines(const DiscontinuityOptions& options) const {
    return static_cast<std::size_t>(options.max_leaf_dsets);
  }

  // Ranks that replace the weights. Without a value, the weights are the ranks.
  virtual std::optional<DiscontinuityRanks> Rank(PatchId /*patch*/, std::span<const Discontinuity> /*found*/,
                                                 const DiscontinuityOptions& /*options*/) const {
    return std::nullopt;
  }

  // A filter that decides for each leaf of the patch. Without a filter, a discontinuity becomes an edge of
  // all leaves that it crosses, or of none. Forest and visibility outlive the function; a single thread calls
  // the function.
  virtual LeafFilter FilterOf(const ElementForest& /*forest*/, const PatchVisibility& /*visibility*/,
                              PatchId /*patch*/) const {
    return {};
  }
};

// The type of DiscontinuityChoices().
using DiscontinuityChoiceRegistry = Registry<const DiscontinuityChoiceMethod>;

}  // namespace penumbra
