// solver/transport/points/leaf_visibility.h
//
// Which sources each leaf of the quadtrees sees, and past which blockers: the lists of the patches, filtered
// down the trees with ever narrower tubes. Irradiance at the leaf's points then looks at few blockers.

#pragma once

#include <span>
#include <vector>

#include "solver/base/progress.h"
#include "solver/transport/links/element_forest.h"
#include "solver/visibility/pair/patch_visibility.h"

namespace penumbra {

class LeafVisibility {
 public:
  LeafVisibility() = default;
  // Of no use if it was cancelled.
  LeafVisibility(const ElementForest& forest, const PatchVisibility& patches,
                 const ExecutionContext& context = ExecutionContext());

  // The source patches that some point of the leaf, or just beside it, may see; ascending.
  std::span<const PatchPair> SourcesOf(ElementId leaf) const {
    return {pairs_.data() + range_[static_cast<std::size_t>(leaf)].first,
            pairs_.data() + range_[static_cast<std::size_t>(leaf)].second};
  }
  // As many of the tube's blockers as tell what is blocked: one at least of those in the way of any segment.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {blockers_.data() + pair.first_blocker, pair.blocker_count};
  }

 private:
  std::vector<std::pair<std::size_t, std::size_t>>
      range_;  // per element, into pairs_; empty unless it is a leaf
  std::vector<PatchPair> pairs_;
  std::vector<PatchId> blockers_;
};

}  // namespace penumbra
