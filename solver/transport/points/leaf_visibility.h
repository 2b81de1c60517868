// solver/transport/points/leaf_visibility.h
//
// The sources that each leaf sees, and the blockers before each source. The lists of a leaf are derived from
// the lists of its patch: each level of the quadtree removes sources and blockers by means of narrower tubes,
// so that few blockers remain to be tested at a point of the leaf.

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
  // The object is useless if the context is cancelled.
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
  std::vector<std::pair<std::size_t, std::size_t>>
      range_;  // of each element, in pairs_; empty unless the element is a leaf
  std::vector<PatchPair> pairs_;
  std::vector<PatchId> blockers_;
};

// Caches the LeafVisibility of a forest whose leaves may change: Get() computes the visibility at the first
// call after construction or Reset().
class LeafVisibilityCache {
 public:
  // Returns null if the context is cancelled.
  std::shared_ptr<const LeafVisibility> Get(const ElementForest& forest, const PatchVisibility& patches,
                                            const ExecutionContext& context);
  // Must be called after leaves have changed.
  void Reset() { found_.reset(); }

 private:
  std::shared_ptr<const LeafVisibility> found_;
};

}  // namespace penumbra
