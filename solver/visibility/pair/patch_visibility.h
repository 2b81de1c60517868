// solver/visibility/pair/patch_visibility.h
//
// The pairs of patches that may see each other, with the blockers in the tube of each pair (thesis 4.1;
// Teller and Hanrahan 1993). The solver makes its initial links from the pairs. All links between two patches
// choose their blockers from the list of the pair.

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// kVisible: no patch blocks light in the pair's tube. kPartial: some patches may block. Pairs that are hidden
// completely by one blocker, or by several walls together, are not stored.
enum class Visibility : std::uint8_t { kVisible, kPartial };

// A source that the front of a receiver may see.
struct PatchPair {
  PatchId source = kNoPatch;
  Visibility visibility = Visibility::kVisible;  // kVisible if and only if there are no blockers
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

class PatchVisibility {
 public:
  // The pairs of all receivers, in compressed rows.
  struct Rows {
    std::vector<std::size_t> first;  // index of the first pair of each receiver; last, pairs.size()
    std::vector<PatchPair> pairs;
    std::vector<PatchId> blockers;
  };

  PatchVisibility() = default;
  // Finds the pairs of the scene. If the context is cancelled, the object has no pairs.
  explicit PatchVisibility(const Scene& scene, const ExecutionContext& context = ExecutionContext());
  // No pairs, for methods that do not need them.
  static PatchVisibility WithoutPairs(const Scene& scene) {
    return PatchVisibility({std::vector<std::size_t>(scene.patches.size() + 1, 0), {}, {}});
  }
  // Only the pairs of the given sources, ascending, with receivers that at most `most_blockers` patches may
  // hide from them: for methods that need the sharp shadows of the strongest sources. The relation is not
  // symmetric. If the context is cancelled, the object has no pairs.
  static PatchVisibility OfSources(const Scene& scene, std::span<const PatchId> sources,
                                   std::size_t most_blockers, const ExecutionContext& context);
  // Restores an object from the result of rows() of another object.
  explicit PatchVisibility(Rows rows) : rows_(std::move(rows)) {}

  // The sources that the receiver's front may see, ascending. For each source in the list, a part of each of
  // the two fronts lies before the plane of the other patch, and neither one blocker nor walls
  // (HiddenByWalls) hide the pair completely. The relation is symmetric: s is a source of r if and only if r
  // is a source of s.
  std::span<const PatchPair> SourcesOf(PatchId receiver) const {
    return {rows_.pairs.data() + rows_.first[receiver], rows_.pairs.data() + rows_.first[receiver + 1]};
  }

  // The patches that intersect the interior of the pair's tube, in ascending order. The list contains every
  // patch that blocks light between the pair.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {rows_.blockers.data() + pair.first_blocker, pair.blocker_count};
  }

  const Rows& rows() const { return rows_; }

 private:
  Rows rows_;
};

}  // namespace penumbra
