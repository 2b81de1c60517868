// Which patches see each other: found through hierarchies and screens as by trying all pairs.

#include "solver/visibility/pair/patch_visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "solver/visibility/pair/tube_blockers.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

// Two by two rooms with thin walls between them, furnished, each wall with a doorway's worth missing or not.
Scene Rooms(Random& random) {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const Vec3 o(4.5 * i, 4.5 * j, 0);
      const std::size_t first = scene.patches.size();
      AddBox(scene, o, o + Vec3(4, 4, 3), true, grey);
      if (random.Index(2) == 0)
        scene.patches.erase(scene.patches.begin() + static_cast<std::ptrdiff_t>(first + 2 + random.Index(4)));
      for (int k = 0; k < 4; ++k) {
        const Vec3 low(0.25 * random.Index(12), 0.25 * random.Index(12), 0);
        AddBox(scene, o + low,
               o + low + Vec3(0.25 + 0.25 * random.Index(3), 0.5, 0.25 + 0.5 * random.Index(4)), false, grey);
      }
    }
  return scene;
}

// Every pair with every patch as a candidate, by brute force.
void ExpectAllPairs(const Scene& scene, int& pairs, int& hidden) {
  const PatchVisibility found(scene);
  std::vector<PatchId> all(scene.patches.size());
  std::iota(all.begin(), all.end(), 0);
  for (const PatchId i : all) {
    auto next = found.SourcesOf(i).begin();
    const auto end = found.SourcesOf(i).end();
    for (const PatchId j : all) {
      if (j == i) continue;
      // The pair as it is looked at: from the lower number.
      const Patch &a = scene.patches[static_cast<std::size_t>(std::min(i, j))],
                  &b = scene.patches[static_cast<std::size_t>(std::max(i, j))];
      const std::optional<TubeEnds> ends = ClipToEachOther(a.Vertices(), a, b.Vertices(), b);
      std::vector<PatchId> blockers;
      const bool sees = ends && FindTubeBlockers(scene, *ends, std::min(i, j), std::max(i, j), all, blockers);
      hidden += ends && !sees;
      if (!sees) {
        ASSERT_TRUE(next == end || next->source != j) << i << " and " << j << " do not see each other";
        continue;
      }
      ++pairs;
      ASSERT_TRUE(next != end && next->source == j) << i << " and " << j << " see each other";
      const std::span<const PatchId> got = found.Blockers(*next);
      ASSERT_TRUE(std::equal(got.begin(), got.end(), blockers.begin(), blockers.end())) << i << " and " << j;
      ASSERT_EQ(next->visibility, blockers.empty() ? Visibility::kVisible : Visibility::kPartial);
      ++next;
    }
    ASSERT_TRUE(next == end);
  }
}

TEST(PatchVisibility, SameAsAllPairs) {
  Random random(611);
  int pairs = 0, hidden = 0;
  for (int i = 0; i < 12; ++i) {
    SCOPED_TRACE(i);
    const Scene scene = i % 2 == 0 ? Rooms(random) : FurnishedRoom(random, 8);
    ExpectAllPairs(i % 3 == 0 ? Mapped(scene, RandomMotion(random, 3)) : scene, pairs, hidden);
  }
  std::printf("seed 611: %d pairs see each other, %d are hidden by one blocker\n", pairs, hidden);
  EXPECT_GT(pairs, 1000);
  EXPECT_GT(hidden, 1000);
}

// The pairs of some sources are those of the whole scene, without pairs that have too many blockers.
TEST(PatchVisibility, OfSourcesIsAPartOfTheWhole) {
  Random random(612);
  std::size_t kept = 0, left_out = 0;
  for (int i = 0; i < 6; ++i) {
    const Scene scene = FurnishedRoom(random, 8);
    const PatchVisibility whole(scene);
    std::vector<PatchId> sources;
    for (PatchId p = 0; p < static_cast<PatchId>(scene.patches.size()); p += 7) sources.push_back(p);
    constexpr std::size_t kMost = 3;
    const PatchVisibility part = PatchVisibility::OfSources(scene, sources, kMost, {});
    for (PatchId r = 0; r < static_cast<PatchId>(scene.patches.size()); ++r) {
      std::vector<PatchId> want, got;
      for (const PatchPair& pair : whole.SourcesOf(r))
        if (std::binary_search(sources.begin(), sources.end(), pair.source)) {
          if (pair.blocker_count <= kMost)
            want.push_back(pair.source);
          else
            ++left_out;
        }
      for (const PatchPair& pair : part.SourcesOf(r)) {
        got.push_back(pair.source);
        EXPECT_LE(part.Blockers(pair).size(), kMost);
        EXPECT_EQ(pair.visibility, part.Blockers(pair).empty() ? Visibility::kVisible : Visibility::kPartial);
      }
      ASSERT_EQ(got, want) << i << " receiver " << r;
      kept += got.size();
    }
  }
  std::printf("seed 612: %zu pairs kept, %zu left out\n", kept, left_out);
  EXPECT_GT(kept, 100u);
  EXPECT_GT(left_out, 10u);
}

}  // namespace
}  // namespace penumbra::scene_test
