// solver/visibility/pair/patch_visibility.h
//
// Which patches see which, and what may stand between them: the initial links of the solver with the blockers
// of their tubes (thesis 4.1; Teller and Hanrahan 1993). Everything below a pair of patches inherits its
// blockers.

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The class of a tube. Pairs that one blocker hides wholly, or walls together, are not kept.
enum class Visibility : std::uint8_t { kVisible, kPartial };

// One source that a receiver's front may see.
struct PatchPair {
  PatchId source = kNoPatch;
  Visibility visibility = Visibility::kVisible;  // kVisible just if there are no blockers
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

class PatchVisibility {
 public:
  // The pairs of all receivers in compressed rows.
  struct Rows {
    std::vector<std::size_t> first;  // per receiver, into pairs; and the end
    std::vector<PatchPair> pairs;
    std::vector<PatchId> blockers;
  };

  PatchVisibility() = default;
  // Without any pairs if it was cancelled.
  explicit PatchVisibility(const Scene& scene, const ExecutionContext& context = ExecutionContext());
  // What another one gave as rows().
  explicit PatchVisibility(Rows rows) : rows_(std::move(rows)) {}

  // The sources that receiver's front may see, ascending: their fronts and its front each have a part before
  // the other's plane, and neither one blocker nor walls (HiddenByWalls) hide them wholly. Symmetric: s is a
  // source of r just if r is one of s.
  std::span<const PatchPair> SourcesOf(PatchId receiver) const {
    return {rows_.pairs.data() + rows_.first[receiver], rows_.pairs.data() + rows_.first[receiver + 1]};
  }

  // The patches that meet the interior of the tube between the pair, ascending; never a true blocker left
  // out.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {rows_.blockers.data() + pair.first_blocker, pair.blocker_count};
  }

  const Rows& rows() const { return rows_; }

 private:
  Rows rows_;
};

}  // namespace penumbra
