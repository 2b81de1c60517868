// mesh/discontinuities/discontinuity_choice.h
//
// Which discontinuities become edges of the mesh: several ways to choose behind one interface.

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

// True if the discontinuity may become an edge of the leaf. Never asked for contacts.
using LeafFilter = std::function<bool(const Discontinuity&, ElementId)>;

// The order in which the discontinuities of a patch are tried.
struct DiscontinuityRanks {
  std::vector<double> rank;  // of each: the highest come first
  double least = 0;          // lower ones are not tried
};

// What is not overridden is the choice by weight (ActivateDiscontinuities).
class DiscontinuityChoiceMethod {
 public:
  virtual ~DiscontinuityChoiceMethod() = default;

  // Whether any discontinuity becomes an edge. If not, none needs to be found.
  virtual bool TakesAny() const { return true; }

  // Whether the weights alone decide, so that refinement may ask for one that was too light.
  virtual bool ByWeightAlone() const { return false; }

  // How many lines may run through the inside of a leaf.
  virtual std::size_t MostLines(const DiscontinuityOptions& options) const {
    return static_cast<std::size_t>(options.max_leaf_dsets);
  }

  // Ranks that take the place of the weights; nothing: the weights are the ranks.
  virtual std::optional<DiscontinuityRanks> Rank(PatchId /*patch*/, std::span<const Discontinuity> /*found*/,
                                                 const DiscontinuityOptions& /*options*/) const {
    return std::nullopt;
  }

  // What decides leaf by leaf on the patch; an empty function: a discontinuity becomes an edge of all leaves
  // that it crosses, or of none. The forest and the visibility outlive the function; one thread calls it.
  virtual LeafFilter FilterOf(const ElementForest& /*forest*/, const PatchVisibility& /*visibility*/,
                              PatchId /*patch*/) const {
    return {};
  }
};

// DiscontinuityChoices() holds all ways to choose.
using DiscontinuityChoiceRegistry = Registry<const DiscontinuityChoiceMethod>;

}  // namespace penumbra
