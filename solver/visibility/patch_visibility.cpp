#include "solver/visibility/patch_visibility.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "solver/base/parallel.h"
#include "solver/visibility/tube_blockers.h"

namespace penumbra {
namespace {

struct Found {
  PatchId other;
  std::vector<PatchId> blockers;
};

std::optional<Found> FindPair(const Scene& scene, std::span<const PatchId> all, PatchId i, PatchId j) {
  const Patch &a = scene.patches[i], &b = scene.patches[j];
  const std::optional<TubeEnds> ends = ClipToEachOther(a.Vertices(), a, b.Vertices(), b);
  if (!ends) return std::nullopt;
  Found found{j, {}};
  if (!FindTubeBlockers(scene, *ends, i, j, all, found.blockers)) return std::nullopt;
  return found;
}

}  // namespace

PatchVisibility::PatchVisibility(const Scene& scene) {
  const std::size_t count = scene.patches.size();
  std::vector<PatchId> all(count);
  std::iota(all.begin(), all.end(), 0);
  std::vector<std::vector<Found>> found(count);  // pairs (i, j) with i < j, at i
  ParallelFor(count, 1, [&](std::size_t i) {
    for (std::size_t j = i + 1; j < count; ++j)
      if (auto pair = FindPair(scene, all, static_cast<PatchId>(i), static_cast<PatchId>(j)))
        found[i].push_back(std::move(*pair));
  });

  std::vector<std::vector<PatchPair>> by_receiver(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const Found& pair : found[i]) {
      PatchPair entry;
      entry.visibility = pair.blockers.empty() ? Visibility::kVisible : Visibility::kPartial;
      entry.first_blocker = static_cast<std::uint32_t>(blockers_.size());
      entry.blocker_count = static_cast<std::uint32_t>(pair.blockers.size());
      blockers_.insert(blockers_.end(), pair.blockers.begin(), pair.blockers.end());
      entry.source = static_cast<PatchId>(i);
      by_receiver[pair.other].push_back(entry);
      entry.source = pair.other;
      by_receiver[i].push_back(entry);
    }
  first_.assign(1, 0);
  for (std::vector<PatchPair>& pairs : by_receiver) {
    std::sort(pairs.begin(), pairs.end(),
              [](const PatchPair& a, const PatchPair& b) { return a.source < b.source; });
    pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
    first_.push_back(pairs_.size());
  }
}

}  // namespace penumbra
