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

// A function that returns true if the discontinuity may become an edge in the quadtree leaf. A LeafFilter is
// never called for contacts with other surfaces, which may always become edges.
using LeafFilter = std::function<bool(const Discontinuity&, ElementId)>;

// Determines the order in which the discontinuities of a patch become edges of the mesh.
struct DiscontinuityRanks {
  // The rank of each discontinuity; the discontinuity of the highest rank is the first to become a mesh edge.
  std::vector<double> rank;
  double least = 0;  // smallest rank of a discontinuity that becomes a mesh edge
};

// A method that chooses the discontinuities that become edges of the mesh. By default, a
// DiscontinuityChoiceMethod chooses discontinuities in order of decreasing weight (ActivateDiscontinuities).
class DiscontinuityChoiceMethod {
 public:
  virtual ~DiscontinuityChoiceMethod() = default;

  // True if the method can make discontinuities edges of the mesh, false if the method always omits all
  // discontinuities. If TakesAny() is false, no discontinuities need to be found.
  virtual bool TakesAny() const { return true; }

  // True if only the weights of discontinuities determine the choice. If ByWeightAlone() is true, mesh
  // refinement may request mesh edges along discontinuities whose weight is below
  // DiscontinuityOptions::min_weight.
  virtual bool ByWeightAlone() const { return false; }

  // The largest number of discontinuity lines that may cross the interior of a quadtree leaf.
  virtual std::size_t MostLines(const DiscontinuityOptions& options) const {
    return static_cast<std::size_t>(options.max_leaf_dsets);
  }

  // Returns a rank for each discontinuity; in the choice of edges, the ranks replace the weights of the
  // discontinuities. If Rank() returns nullopt, the weights of the discontinuities are used as ranks.
  virtual std::optional<DiscontinuityRanks> Rank(PatchId /*patch*/, std::span<const Discontinuity> /*found*/,
                                                 const DiscontinuityOptions& /*options*/) const {
    return std::nullopt;
  }

  // Returns a filter of discontinuities for the quadtree leaves of the patch. If FilterOf() returns an empty
  // function, a discontinuity becomes either an edge in all leaves that it crosses, or in no leaf. The
  // ElementForest and the PatchVisibility outlive the returned filter, and only one thread calls the filter.
  virtual LeafFilter FilterOf(const ElementForest& /*forest*/, const PatchVisibility& /*visibility*/,
                              PatchId /*patch*/) const {
    return {};
  }
};

// The type of the registry of all methods that choose discontinuities; DiscontinuityChoices() returns the
// registry.
using DiscontinuityChoiceRegistry = Registry<const DiscontinuityChoiceMethod>;

}  // namespace penumbra
