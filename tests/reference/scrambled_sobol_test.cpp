#include "experiments/reference/scrambled_sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace penumbra {
namespace {

// 2^k points stratify every dimension into 2^k intervals, also those that follow; the first two dimensions
// together fill every elementary rectangle.
TEST(ScrambledSobol, Stratifies) {
  constexpr int kBits = 10, kPoints = 1 << kBits;
  ScrambledSobol points(7, 3);
  for (int block = 0; block < 2; ++block) {
    std::array<std::set<int>, ScrambledSobol::kDimensions> seen;
    std::array<std::set<int>, kBits + 1> rectangles;
    for (int i = 0; i < kPoints; ++i) {
      const ScrambledSobol::Point p = points.Next();
      for (std::size_t d = 0; d < p.size(); ++d) {
        ASSERT_GT(p[d], 0);
        ASSERT_LT(p[d], 1);
        seen[d].insert(static_cast<int>(p[d] * kPoints));
      }
      for (int k = 0; k <= kBits; ++k)
        rectangles[static_cast<std::size_t>(k)].insert(static_cast<int>(p[0] * (1 << k)) * (kPoints >> k) +
                                                       static_cast<int>(p[1] * (kPoints >> k)));
    }
    for (const std::set<int>& intervals : seen)
      EXPECT_EQ(intervals.size(), static_cast<std::size_t>(kPoints));
    for (const std::set<int>& cells : rectangles) EXPECT_EQ(cells.size(), static_cast<std::size_t>(kPoints));
  }
}

// No two dimensions hang together: the mean of the product of any two is that of independent numbers, and
// scrambles differ.
TEST(ScrambledSobol, DimensionsAreIndependent) {
  constexpr int kPoints = 1 << 14;
  ScrambledSobol points(1, 0), others(1, 1);
  EXPECT_NE(points.Next()[0], others.Next()[0]);
  std::array<ScrambledSobol::Point, ScrambledSobol::kDimensions> product{};
  for (int i = 0; i < kPoints; ++i) {
    const ScrambledSobol::Point p = others.Next();
    for (std::size_t a = 0; a < p.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) product[a][b] += (p[a] - 0.5) * (p[b] - 0.5) * 12 / kPoints;
  }
  // Independent random numbers would correlate by 0.008.
  for (std::size_t a = 0; a < product.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_LE(std::abs(product[a][b]), 0.008) << a << " and " << b;
}

}  // namespace
}  // namespace penumbra
