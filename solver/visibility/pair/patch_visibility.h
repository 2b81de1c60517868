// solver/visibility/pair/patch_visibility.h
//
// The pairs of patches that may see each other, with the blockers in the tube (convex hull) of each pair
// (thesis 4.1; Teller and Hanrahan 1993). The hierarchical solver makes its initial links from the pairs of
// patches that may see each other. The blockers of a link between elements of two patches are chosen from the
// blockers of the pair of patches.

#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "solver/base/progress.h"
#include "solver/scene/scene.h"

namespace penumbra {

// The visibility of a pair of patches: with kVisible, no patch blocks light between them; with kPartial, some
// patches may block light. Pairs of patches that one blocker, or several walls together, hide from each other
// completely are not stored.
enum class Visibility : std::uint8_t { kVisible, kPartial };

// A source patch that may be visible from the front of a receiver, with the range of the pair's blockers in
// Rows::blockers.
struct PatchPair {
  PatchId source = kNoPatch;
  // KVisible if and only if the pair of patches has no blockers.
  Visibility visibility = Visibility::kVisible;
  std::uint32_t first_blocker = 0, blocker_count = 0;
};

class PatchVisibility {
 public:
  // The pairs of patches, stored as compressed rows by receiver: receiver i has the pairs first[i] to first[i
  // + 1] - 1.
  struct Rows {
    // The index of the first pair of each receiver; the last entry is pairs.size().
    std::vector<std::size_t> first;
    std::vector<PatchPair> pairs;
    std::vector<PatchId> blockers;
  };

  PatchVisibility() = default;
  // Finds all pairs of patches of the scene that may see each other. If the context is cancelled, the
  // PatchVisibility has no pairs of patches.
  explicit PatchVisibility(const Scene& scene, const ExecutionContext& context = ExecutionContext());
  // A PatchVisibility without pairs of patches, for solvers that do not need pairs.
  static PatchVisibility WithoutPairs(const Scene& scene) {
    return PatchVisibility({std::vector<std::size_t>(scene.patches.size() + 1, 0), {}, {}});
  }
  // Finds only the pairs of one of the given sources and a receiver with at most `most_blockers` blockers
  // between them. OfSources() serves callers that need sharp shadows only of the strongest sources. The pairs
  // that OfSources() finds are not symmetric: s may be a source of r although r is not a source of s. If the
  // context is cancelled, the returned PatchVisibility has no pairs of patches. REQUIRES: `sources` is
  // ascending.
  static PatchVisibility OfSources(const Scene& scene, std::span<const PatchId> sources,
                                   std::size_t most_blockers, const ExecutionContext& context);
  // Restores a PatchVisibility from the result of rows() of another object.
  explicit PatchVisibility(Rows rows) : rows_(std::move(rows)) {}

  // The sources that may be visible from the receiver's front, ascending. For each source in the list, a part
  // of the source's front lies in front of the receiver's plane, and a part of the receiver's front lies in
  // front of the source's plane. Sources that one blocker or several walls (HiddenByWalls) hide from the
  // receiver completely are not in the list. The relation between sources and receivers is symmetric: s is a
  // source of r if and only if r is a source of s.
  std::span<const PatchPair> SourcesOf(PatchId receiver) const {
    return {rows_.pairs.data() + rows_.first[receiver], rows_.pairs.data() + rows_.first[receiver + 1]};
  }

  // The patches that intersect the interior of the tube (convex hull) of a pair of patches, in ascending
  // order. The list contains every patch that blocks light between the two patches.
  std::span<const PatchId> Blockers(const PatchPair& pair) const {
    return {rows_.blockers.data() + pair.first_blocker, pair.blocker_count};
  }

  const Rows& rows() const { return rows_; }

 private:
  Rows rows_;
};

}  // namespace penumbra
