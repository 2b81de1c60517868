// Which segments come close to each other.

#include "solver/geometry/nearby_segments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "solver/base/random.h"
#include "solver/base/size.h"
#include "solver/geometry/orientation.h"

namespace penumbra {
namespace {

std::vector<PlaneSegment> Closed(const std::vector<Vec2>& outline) {
  std::vector<PlaneSegment> edges;
  for (std::size_t i = 0; i < outline.size(); ++i)
    edges.push_back({outline[i], outline[(i + 1) % outline.size()]});
  return edges;
}

std::vector<Vec2> Star(int spikes) {
  std::vector<Vec2> outline;
  for (int i = 0; i < spikes; ++i) {
    const double tip = 2 * std::numbers::pi * i / spikes, notch = 2 * std::numbers::pi * (i + 0.5) / spikes;
    outline.emplace_back(10 * std::cos(tip), 10 * std::sin(tip));
    outline.emplace_back(0.5 * std::cos(notch), 0.5 * std::sin(notch));
  }
  return outline;
}

bool Meet(const PlaneSegment& s, const PlaneSegment& t) {
  return Orientation(s.a, s.b, t.a) * Orientation(s.a, s.b, t.b) <= 0 &&
         Orientation(t.a, t.b, s.a) * Orientation(t.a, t.b, s.b) <= 0;
}

// All pairs that meet are found, among short and long segments, with points among them.
TEST(NearbySegments, AreTheSameAsByComparingAll) {
  Random random(7);
  for (const double length : {0.02, 0.2, 1.0}) {
    std::vector<PlaneSegment> segments;
    for (int i = 0; i < 300; ++i) {
      const Vec2 a(random.Uniform(), random.Uniform());
      const double turn = random.Uniform(0, 2 * std::numbers::pi);
      segments.push_back({a, a + length * random.Uniform() * Vec2(std::cos(turn), std::sin(turn))});
      if (i % 5 == 0) segments.push_back({segments.back().b, segments.back().b});
    }
    const auto pairs = FindNearbyPairs(segments, 1e-13);
    ASSERT_TRUE(pairs);
    EXPECT_TRUE(std::is_sorted(pairs->begin(), pairs->end()));
    std::size_t meeting = 0;
    for (std::int32_t i = 0; i < Size(segments); ++i)
      for (std::int32_t k = i + 1; k < Size(segments); ++k) {
        if (segments[k].a == segments[k].b || !Meet(segments[i], segments[k])) continue;
        ++meeting;
        EXPECT_TRUE(std::binary_search(pairs->begin(), pairs->end(), std::pair(i, k)));
      }
    EXPECT_GT(meeting, 0U);
    for (std::int32_t k = 1; k < Size(segments); ++k) {
      if (segments[k].a != segments[k].b) continue;
      EXPECT_TRUE(std::binary_search(pairs->begin(), pairs->end(), std::pair(k - 1, k)));  // an end of its
    }
  }
}

// The spikes of a star come close only to their neighbours, although their boxes overlap by the square of
// their number. What takes too long is told instead.
TEST(NearbySegments, SpikesHaveTwoNeighbours) {
  const std::vector<PlaneSegment> spikes = Closed(Star(50'000));
  const auto pairs = FindNearbyPairs(spikes, 1e-13);
  ASSERT_TRUE(pairs);
  EXPECT_EQ(pairs->size(), spikes.size());
  std::vector<PlaneSegment> diameters;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 end(std::cos(1e-4 * i), std::sin(1e-4 * i));
    diameters.push_back({end, -end});
  }
  EXPECT_FALSE(FindNearbyPairs(diameters, 1e-13));
}

}  // namespace
}  // namespace penumbra
