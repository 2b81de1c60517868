#include "mesh/discontinuities/shadow_crossing.h"

#include <algorithm>

namespace penumbra {
namespace {

// The distance between test points and corners, relative to the distance to the centre. Objects that touch a
// corner should not affect the result: a choice.
constexpr double kInwards = 1e-3;

bool Blocks(const Patch& patch, const Vec3& x, const Vec3& y) {
  const double hx = patch.normal.dot(x - patch.vertex[0]), hy = patch.normal.dot(y - patch.vertex[0]);
  if (!(hx * hy < 0)) return false;
  return ConvexContains(patch.Vertices(), patch.normal, x + (hx / (hx - hy)) * (y - x), 0);
}

}  // namespace

ShadowCrossing::ShadowCrossing(const ElementForest& forest, const PatchVisibility& visibility,
                               PatchId receiver)
    : forest_(forest), visibility_(visibility), receiver_(receiver) {}

bool ShadowCrossing::Crosses(PatchId source, ElementId leaf) {
  const std::uint64_t key =
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(source)) << 32 | static_cast<std::uint32_t>(leaf);
  const auto [place, added] = known_.try_emplace(key, false);
  if (!added) return place->second;
  const std::span<const Vec3> corners = forest_[leaf].Vertices();
  const Vec3 centre = Centroid(corners);
  const std::uint32_t seen = SeenFrom(centre, source);
  place->second = std::any_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
    return SeenFrom(corner + kInwards * (centre - corner), source) != seen;
  });
  return place->second;
}

// One bit for each of the source's points: set if the point is visible from x.
std::uint32_t ShadowCrossing::SeenFrom(const Vec3& x, PatchId source) const {
  const Patch& patch = forest_.scene().patches[source];
  if (!(patch.normal.dot(x - patch.vertex[0]) > 0)) return 0;
  const std::span<const PatchPair> pairs = visibility_.SourcesOf(receiver_);
  const auto pair = std::lower_bound(pairs.begin(), pairs.end(), source,
                                     [](const PatchPair& p, PatchId id) { return p.source < id; });
  if (pair == pairs.end() || pair->source != source) return 0;
  const std::span<const PatchId> blockers = visibility_.Blockers(*pair);
  const Vec3 centre = Centroid(patch.Vertices());
  std::uint32_t seen = 0;
  for (std::int32_t k = 0; k <= patch.size; ++k) {
    const Vec3 y = k == patch.size ? centre : patch.vertex[k] + kInwards * (centre - patch.vertex[k]);
    const bool hidden = std::any_of(blockers.begin(), blockers.end(), [&](PatchId blocker) {
      return Blocks(forest_.scene().patches[blocker], x, y);
    });
    if (!hidden) seen |= 1U << k;
  }
  return seen;
}

}  // namespace penumbra
