#include "solver/visibility/patch_visibility.h"

#include <algorithm>
#include <optional>

#include "solver/base/parallel.h"
#include "solver/visibility/tube.h"

namespace penumbra {
namespace {

// Of a height above a plane, relative to the coordinates: what rounding of vertices and normal can make of
// zero. Patches that see each other only by less than this lie in one plane.
constexpr double kCoplanar = 1e-12;

// The part of `patch` before the plane of `other`; empty if that is nothing beyond rounding.
Polygon3 PartBefore(const Patch& patch, const Patch& other) {
  double highest = 0, scale = 0;
  for (const Vec3& v : patch.Vertices()) {
    highest = std::max(highest, other.normal.dot(v - other.vertex[0]));
    scale = std::max({scale, MaxAbs(v), MaxAbs(other.vertex[0])});
  }
  if (highest <= kCoplanar * scale) return {};
  return ClipToHalfSpace(patch.Vertices(), other.normal, other.vertex[0], kCoplanar * scale);
}

struct Found {
  PatchId other;
  std::vector<PatchId> blockers;
};

std::optional<Found> FindPair(const Scene& scene, PatchId i, PatchId j) {
  const Polygon3 a = PartBefore(scene.patches[i], scene.patches[j]);
  if (a.empty()) return std::nullopt;
  const Polygon3 b = PartBefore(scene.patches[j], scene.patches[i]);
  if (b.empty()) return std::nullopt;
  const Tube tube(a, b);
  Found found{j, {}};
  for (PatchId k = 0; k < static_cast<PatchId>(scene.patches.size()); ++k) {
    if (k == i || k == j) continue;
    const Patch& blocker = scene.patches[k];
    if (tube.Misses(blocker.Vertices(), blocker.normal)) continue;
    if (tube.HiddenBy(blocker.Vertices(), blocker.normal)) return std::nullopt;
    found.blockers.push_back(k);
  }
  return found;
}

}  // namespace

PatchVisibility::PatchVisibility(const Scene& scene) {
  const std::size_t count = scene.patches.size();
  std::vector<std::vector<Found>> found(count);  // pairs (i, j) with i < j, at i
  ParallelFor(count, 1, [&](std::size_t i) {
    for (std::size_t j = i + 1; j < count; ++j)
      if (auto pair = FindPair(scene, static_cast<PatchId>(i), static_cast<PatchId>(j)))
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
