// solver/transport/points/leaf_visibility.h
//
// The sources that each leaf sees, and the blockers before each source. The lists of the patches are filtered
// down the quadtrees with narrower and narrower tubes, so that irradiance at a point of a leaf has few
// blockers to test.

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
  // Useless if the context is cancelled.
  LeafVisibility(const ElementForest& forest, const PatchVisibility& patches,
                 const ExecutionContext& context = ExecutionContext());

  // The source patches that a point in the leaf or just outside it may see, ascending.
  std::span<const PatchPair> SourcesOf(ElementId leaf) const {
    return {pairs_.data() + range_[static_cast<std::size_t>(leaf)].first,
            pairs_.data() + range_[static_cast<std::size_t>(leaf)].second};
  }
  // Blockers that decide what is hidden: for any blocked segment between leaf and source, at least one of its
  // blockers.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {blockers_.data() + pair.first_blocker, pair.blocker_count};
  }

 private:
  std::vector<std::pair<std::size_t, std::size_t>>
      range_;  // of each element, in pairs_; empty unless the element is a leaf
  std::vector<PatchPair> pairs_;
  std::vector<PatchId> blockers_;
};

// The visibility of the leaves of a forest that grows: found when it is first asked for after a change.
class LeafVisibilityCache {
 public:
  // Null if cancelled.
  std::shared_ptr<const LeafVisibility> Get(const ElementForest& forest, const PatchVisibility& patches,
                                            const ExecutionContext& context);
  // For use after leaves have changed.
  void Reset() { found_.reset(); }

 private:
  std::shared_ptr<const LeafVisibility> found_;
};

}  // namespace penumbra
