#include "solver/visibility/pair/patch_visibility.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "solver/base/parallel.h"
#include "solver/visibility/pair/patch_hierarchy.h"
#include "solver/visibility/pair/tube_blockers.h"

namespace penumbra {
namespace {

struct Found {
  PatchId other;
  std::vector<PatchId> blockers;
};

// The largest number of screens for one patch, and their smallest solid angle [sr].
constexpr std::size_t kMostScreens = 16;
constexpr double kLeastScreen = 0.02;

// Finds the patches that see a given patch.
class PairFinder {
 public:
  explicit PairFinder(const Scene& scene) : scene_(scene), screens_(scene) {
    std::vector<PatchId> all(scene.patches.size());
    std::iota(all.begin(), all.end(), 0);
    patches_ = PatchHierarchy(scene, std::move(all));
  }

  // The patches with numbers of at least `least` that see patch i, ascending, with their blockers. Incomplete
  // if cancelled.
  std::vector<Found> Find(PatchId i, PatchId least, const ExecutionContext& context) const {
    const Patch& patch = scene_.patches[i];
    std::vector<ReceiverPoint> corners;
    for (const Vec3& v : patch.Vertices()) corners.push_back({v, patch.normal, Vec3::Zero(), 0});
    std::vector<Screen> screens;
    screens_.Find(corners, kLeastScreen, kMostScreens, screens);
    std::vector<PatchId> in_sight;
    patches_.Find({{patch.normal, patch.normal.dot(patch.vertex[0])}}, screens, in_sight);
    std::vector<Found> found;
    for (const PatchId j : in_sight) {
      if (j < least || j == i) continue;
      if (context.Cancelled()) break;
      const Patch& other = scene_.patches[j];
      const std::optional<TubeEnds> ends = ClipToEachOther(patch.Vertices(), patch, other.Vertices(), other);
      Found pair{j, {}};
      if (ends && FindTubeBlockers(scene_, *ends, i, j, patches_, pair.blockers))
        found.push_back(std::move(pair));
    }
    return found;
  }

 private:
  const Scene& scene_;
  ScreenFinder screens_;
  PatchHierarchy patches_;
};

}  // namespace

PatchVisibility PatchVisibility::OfSources(const Scene& scene, std::span<const PatchId> sources,
                                           std::size_t most_blockers, const ExecutionContext& context) {
  const PairFinder finder(scene);
  std::vector<std::vector<Found>> found(sources.size());
  ParallelFor(sources.size(), 1, [&](std::size_t i) {
    if (!context.Cancelled()) found[i] = finder.Find(sources[i], 0, context);
  });
  if (context.Cancelled()) return WithoutPairs(scene);
  Rows rows;
  std::vector<std::vector<PatchPair>> by_receiver(scene.patches.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
    for (const Found& pair : found[i]) {
      if (pair.blockers.size() > most_blockers) continue;
      by_receiver[static_cast<std::size_t>(pair.other)].push_back(
          {sources[i], pair.blockers.empty() ? Visibility::kVisible : Visibility::kPartial,
           static_cast<std::uint32_t>(rows.blockers.size()),
           static_cast<std::uint32_t>(pair.blockers.size())});
      rows.blockers.insert(rows.blockers.end(), pair.blockers.begin(), pair.blockers.end());
    }
  rows.first.assign(1, 0);
  for (const std::vector<PatchPair>& pairs : by_receiver) {
    rows.pairs.insert(rows.pairs.end(), pairs.begin(), pairs.end());
    rows.first.push_back(rows.pairs.size());
  }
  return PatchVisibility(std::move(rows));
}

PatchVisibility::PatchVisibility(const Scene& scene, const ExecutionContext& context) {
  const std::size_t count = scene.patches.size();
  const PairFinder finder(scene);
  std::vector<std::vector<Found>> found(count);  // found[i] holds the pairs (i, j) with i < j
  ParallelFor(count, 1, [&](std::size_t i) {
    if (!context.Cancelled())
      found[i] = finder.Find(static_cast<PatchId>(i), static_cast<PatchId>(i) + 1, context);
  });
  std::vector<std::vector<PatchPair>> by_receiver(count);
  for (std::size_t i = 0; i < count && !context.Cancelled(); ++i) {
    for (const Found& pair : found[i]) {
      PatchPair entry;
      entry.visibility = pair.blockers.empty() ? Visibility::kVisible : Visibility::kPartial;
      entry.first_blocker = static_cast<std::uint32_t>(rows_.blockers.size());
      entry.blocker_count = static_cast<std::uint32_t>(pair.blockers.size());
      rows_.blockers.insert(rows_.blockers.end(), pair.blockers.begin(), pair.blockers.end());
      entry.source = static_cast<PatchId>(i);
      by_receiver[pair.other].push_back(entry);
      entry.source = pair.other;
      by_receiver[i].push_back(entry);
    }
    found[i] = {};  // frees memory early
  }
  rows_.first.assign(1, 0);
  for (std::vector<PatchPair>& pairs : by_receiver) {
    if (context.Cancelled()) break;
    std::sort(pairs.begin(), pairs.end(),
              [](const PatchPair& a, const PatchPair& b) { return a.source < b.source; });
    rows_.pairs.insert(rows_.pairs.end(), pairs.begin(), pairs.end());
    rows_.first.push_back(rows_.pairs.size());
    pairs = {};
  }
  if (!context.Cancelled()) return;
  rows_ = {};
  rows_.first.assign(count + 1, 0);
}

}  // namespace penumbra
