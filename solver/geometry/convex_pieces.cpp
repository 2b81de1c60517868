#include "solver/geometry/convex_pieces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "solver/base/size.h"

namespace penumbra {
namespace {

double SineOfTurn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double lengths = (b - a).norm() * (c - b).norm();
  return lengths > 0 ? Cross2(b - a, c - b) / lengths : 0;
}

bool IsStraight(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).dot(c - b) > 0 && std::abs(SineOfTurn(a, b, c)) <= kStraightSine;
}

// Two triangles that can be joined.
struct Pair {
  std::int32_t first = 0, second = 0;
  ConvexPiece joined;
  double quality = 0;
};

std::vector<Pair> FindPairs(std::span<const Vec2> vertices,
                            std::span<const std::array<std::int32_t, 3>> triangles) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, int>> side;
  for (std::int32_t t = 0; t < Size(triangles); ++t)
    for (int k = 0; k < 3; ++k) side[{triangles[t][k], triangles[t][(k + 1) % 3]}] = {t, k};
  std::vector<Pair> pairs;
  for (const auto& [edge, at] : side) {
    const auto other = side.find({edge.second, edge.first});
    if (other == side.end() || other->second.first < at.first) continue;
    // From the far corner of one triangle around over the far corner of the other.
    const std::int32_t apex = triangles[at.first][(at.second + 2) % 3];
    const std::int32_t opposite = triangles[other->second.first][(other->second.second + 2) % 3];
    ConvexPiece joined{{apex, edge.first, opposite, edge.second}};
    const double quality =
        QuadrilateralQuality(vertices[apex], vertices[edge.first], vertices[opposite], vertices[edge.second]);
    if (quality <= 0) continue;
    std::rotate(joined.vertex.begin(), std::min_element(joined.vertex.begin(), joined.vertex.end()),
                joined.vertex.end());
    pairs.push_back({at.first, other->second.first, joined, quality});
  }
  // The best first; of equals the first in the list of triangles.
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    if (a.quality != b.quality) return a.quality > b.quality;
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return pairs;
}

}  // namespace

double QuadrilateralQuality(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double worst =
      std::min({SineOfTurn(a, b, c), SineOfTurn(b, c, d), SineOfTurn(c, d, a), SineOfTurn(d, a, b)});
  return worst > kStraightSine ? worst : 0;
}

std::vector<std::int32_t> WithoutStraightCorners(std::span<const Vec2> outline) {
  const std::int32_t size = Size(outline);
  std::vector<std::int32_t> kept;
  std::int32_t left = size;  // corners that are kept or not yet looked at
  for (std::int32_t i = 0; i < size; ++i) {
    const std::int32_t before = kept.empty() ? size - 1 : kept.back();
    const std::int32_t after = i + 1 < size ? i + 1 : kept.empty() ? 0 : kept.front();
    if (left > 3 && IsStraight(outline[before], outline[i], outline[after]))
      --left;
    else
      kept.push_back(i);
  }
  return kept;
}

std::vector<ConvexPiece> JoinTriangles(std::span<const Vec2> vertices,
                                       std::span<const std::array<std::int32_t, 3>> triangles) {
  const std::vector<Pair> pairs = FindPairs(vertices, triangles);
  std::vector<int> partners(triangles.size(), 0);
  std::vector<std::vector<std::int32_t>> pairs_of(triangles.size());
  for (std::int32_t p = 0; p < Size(pairs); ++p)
    for (const std::int32_t t : {pairs[p].first, pairs[p].second}) {
      ++partners[t];
      pairs_of[t].push_back(p);
    }

  std::vector<char> taken(triangles.size(), 0), dropped(pairs.size(), 0);
  std::vector<std::int32_t> joined_by(triangles.size(), -1);
  std::vector<std::int32_t> lonely;  // triangles with a single partner left
  for (std::int32_t t = 0; t < Size(triangles); ++t)
    if (partners[t] == 1) lonely.push_back(t);
  const auto drop = [&](std::int32_t p) {
    if (dropped[p]) return;
    dropped[p] = 1;
    for (const std::int32_t t : {pairs[p].first, pairs[p].second})
      if (--partners[t] == 1 && !taken[t]) lonely.push_back(t);
  };
  const auto join = [&](std::int32_t p) {
    taken[pairs[p].first] = taken[pairs[p].second] = 1;
    joined_by[pairs[p].first] = p;
    for (const std::int32_t t : {pairs[p].first, pairs[p].second})
      for (const std::int32_t other : pairs_of[t]) drop(other);
  };
  std::size_t next_lonely = 0;
  for (std::int32_t best = 0;;) {
    if (next_lonely < lonely.size()) {
      const std::int32_t t = lonely[next_lonely++];
      for (const std::int32_t p : pairs_of[t])
        if (!dropped[p]) {
          join(p);
          break;
        }
      continue;
    }
    while (best < Size(pairs) && dropped[best]) ++best;
    if (best == Size(pairs)) break;
    join(best);
  }

  std::vector<ConvexPiece> pieces;
  for (std::int32_t t = 0; t < Size(triangles); ++t) {
    if (joined_by[t] >= 0) pieces.push_back(pairs[joined_by[t]].joined);
    if (taken[t]) continue;
    pieces.push_back({{triangles[t][0], triangles[t][1], triangles[t][2], -1}});
  }
  return pieces;
}

}  // namespace penumbra
