// solver/transport/points/leaf_visibility.h
//
// The source patches that each leaf (undivided quadtree element) sees, and the blockers between the leaf and
// each source. The lists of sources and blockers of a leaf are derived from the lists of the leaf's patch.
// Each level of the quadtree removes sources and blockers that lie outside narrower tubes (convex hulls of
// element and source), so that few blockers remain to be tested at a point of the leaf.

#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

class LeafVisibility {
 public:
  LeafVisibility() = default;
  // If the computation is cancelled (ExecutionContext), the LeafVisibility must not be used.
  LeafVisibility(const ElementForest& forest, const PatchVisibility& patches,
                 const ExecutionContext& context = ExecutionContext());

  // The source patches, in ascending order, that a point in the leaf or just outside the leaf may see.
  std::span<const PatchPair> SourcesOf(ElementId leaf) const {
    return {pairs_.data() + range_[static_cast<std::size_t>(leaf)].first,
            pairs_.data() + range_[static_cast<std::size_t>(leaf)].second};
  }
  // A list of patches that contains, for every blocked segment between the leaf and the source, at least one
  // patch that blocks the segment.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {blockers_.data() + pair.first_blocker, pair.blocker_count};
  }

 private:
  // For each element, the range of its sources in pairs_; empty unless the element is a leaf.
  std::vector<std::pair<std::size_t, std::size_t>> range_;
  std::vector<PatchPair> pairs_;
  std::vector<PatchId> blockers_;
};

// Caches the LeafVisibility of a forest whose leaves may change: Get() computes the visibility at the first
// call after construction or Reset().
class LeafVisibilityCache {
 public:
  // Get() returns null if the computation is cancelled (ExecutionContext).
  std::shared_ptr<const LeafVisibility> Get(const ElementForest& forest, const PatchVisibility& patches,
                                            const ExecutionContext& context);
  // Reset() must be called after leaves have changed.
  void Reset() { found_.reset(); }

 private:
  std::shared_ptr<const LeafVisibility> found_;
};

}  // namespace penumbra
