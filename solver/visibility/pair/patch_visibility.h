// solver/visibility/pair/patch_visibility.h
//
// The pairs of patches that may see each other, with the blockers in the tube of each pair (thesis 4.1;
// Teller and Hanrahan 1993). The solver makes its initial links from the pairs. All links between two patches
// choose their blockers from those of the pair.

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The class of a pair's tube. Pairs that one blocker, or walls together, hide completely are not stored.
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
  // Finds the pairs of the scene. Has no pairs if the context is cancelled.
  explicit PatchVisibility(const Scene& scene, const ExecutionContext& context = ExecutionContext());
  // Restores an object from the rows() of another.
  explicit PatchVisibility(Rows rows) : rows_(std::move(rows)) {}

  // The sources that the receiver's front may see, ascending. Each of the two fronts has a part before the
  // other's plane, and neither one blocker nor walls (HiddenByWalls) hide the pair completely. Symmetric: s
  // is a source of r if and only if r is a source of s.
  std::span<const PatchPair> SourcesOf(PatchId receiver) const {
    return {rows_.pairs.data() + rows_.first[receiver], rows_.pairs.data() + rows_.first[receiver + 1]};
  }

  // The patches that meet the interior of the pair's tube, ascending. No patch that blocks is missing.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {rows_.blockers.data() + pair.first_blocker, pair.blocker_count};
  }

  const Rows& rows() const { return rows_; }

 private:
  Rows rows_;
};

}  // namespace penumbra
