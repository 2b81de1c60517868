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

// A function that returns true if the discontinuity may become an edge of the leaf. The filter is never
// called for contacts, which are always permitted.
using LeafFilter = std::function<bool(const Discontinuity&, ElementId)>;

// Determines the order in which the discontinuities of a patch become edges of the mesh.
struct DiscontinuityRanks {
  std::vector<double> rank;  // of each discontinuity; the highest comes first
  double least = 0;          // the activation omits lower ranks
};

// A method to choose discontinuities. The default implementations of the functions choose by weight
// (ActivateDiscontinuities).
class DiscontinuityChoiceMethod {
 public:
  virtual ~DiscontinuityChoiceMethod() = default;

  // True if the method makes any discontinuity an edge. If TakesAny() is false, no discontinuities need to be
  // found.
  virtual bool TakesAny() const { return true; }

  // True if only the weights determine the choice. If ByWeightAlone() is true, refinement may request
  // discontinuities whose weight is below the minimum.
  virtual bool ByWeightAlone() const { return false; }

  // The largest number of lines that may cross the interior of a leaf.
  virtual std::size_t MostLines(const DiscontinuityOptions& options) const {
    return static_cast<std::size_t>(options.max_leaf_dsets);
  }

  // Ranks of the discontinuities, which replace their weights. If Rank() returns nullopt, the weights are
  // used as ranks.
  virtual std::optional<DiscontinuityRanks> Rank(PatchId /*patch*/, std::span<const Discontinuity> /*found*/,
                                                 const DiscontinuityOptions& /*options*/) const {
    return std::nullopt;
  }

  // A filter for the leaves of the patch. If FilterOf() returns an empty function, a discontinuity becomes
  // either an edge of all leaves that it crosses, or of no leaf. Forest and visibility outlive the filter;
  // only one thread calls the filter.
  virtual LeafFilter FilterOf(const ElementForest& /*forest*/, const PatchVisibility& /*visibility*/,
                              PatchId /*patch*/) const {
    return {};
  }
};

// The type of DiscontinuityChoices().
using DiscontinuityChoiceRegistry = Registry<const DiscontinuityChoiceMethod>;

}  // namespace penumbra
