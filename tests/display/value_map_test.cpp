// Drawings of values on a grid: round ticks, and contour lines where the values are.

#include "display/value_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "display/round_ticks.h"

namespace penumbra {
namespace {

using testing::HasSubstr;

// Ticks are multiples of one round step within the range, not too many, and more than half as many as allowed
// could be, since steps grow by 2.5 at most.
TEST(RoundTicks, AreRoundAndEnough) {
  for (const auto& [low, high] : {std::pair(0.0, 1.0), {0.0, 734.0}, {-3.2, 5.1}, {1e-9, 3e-9}, {0.0, 6e7}}) {
    const std::vector<double> ticks = RoundTicks(low, high, 10);
    ASSERT_GE(ticks.size(), 4u) << low << " to " << high;
    EXPECT_LE(ticks.size(), 10u);
    const double step = ticks[1] - ticks[0];
    const double digit = step / std::pow(10, std::floor(std::log10(step * (1 + 1e-9))));
    EXPECT_TRUE(std::abs(digit - 1) < 1e-6 || std::abs(digit - 2) < 1e-6 || std::abs(digit - 2.5) < 1e-6 ||
                std::abs(digit - 5) < 1e-6)
        << digit;
    for (const double tick : ticks) {
      EXPECT_GE(tick, low - 1e-9 * step);
      EXPECT_LE(tick, high + 1e-9 * step);
      EXPECT_NEAR(tick / step, std::round(tick / step), 1e-6);
    }
  }
  EXPECT_EQ(RoundTicks(2, 2, 5), std::vector<double>{2});
}

// The contour of a cone is a circle: its length is that, and every end lies on it.
TEST(ContourLines, OfAConeAreCircles) {
  constexpr int kSide = 81;
  ValueGrid grid{kSide, kSide, {}};
  const Vec2 middle(40.3, 39.8);
  for (int row = 0; row < kSide; ++row)
    for (int column = 0; column < kSide; ++column) grid.values.push_back((Vec2(column, row) - middle).norm());
  for (const double radius : {5.0, 20.0, 35.0}) {
    double length = 0;
    for (const auto& [a, b] : ContourLines(grid, radius)) {
      length += (a - b).norm();
      EXPECT_NEAR((a - middle).norm(), radius, 0.15 / radius + 0.02);
    }
    EXPECT_NEAR(length, 2 * std::numbers::pi * radius, 0.02 * radius);
  }
  // A saddle's lines do not cross: two of them, whichever way.
  EXPECT_EQ(ContourLines({2, 2, {1, 0, 0, 1}}, 0.4).size(), 2u);
  EXPECT_TRUE(ContourLines({2, 2, {1, 0, std::numeric_limits<double>::quiet_NaN(), 1}}, 0.4).empty());
}

// The drawing holds a square for each value, none where there is none, and the ticks of its scale; names from
// files do no harm.
TEST(ValueMap, IsDrawn) {
  ValueMap map;
  map.grid = {3, 2, {0, 100, 200, 300, std::numeric_limits<double>::quiet_NaN(), 500}};
  map.title = "a < b & c";
  map.unit = "lux";
  const std::string svg = ValueMapSvg(map);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  for (const char* tick : {">100<", ">500<", ">lux<", ">x [m]<"}) EXPECT_THAT(svg, HasSubstr(tick));
  std::size_t squares = 0;
  const std::string cells = svg.substr(svg.find("<g"), svg.find("</g>") - svg.find("<g"));
  for (std::size_t at = cells.find("<rect"); at != cells.npos; at = cells.find("<rect", at + 1)) ++squares;
  EXPECT_EQ(squares, 5u);
  EXPECT_THAT(svg, testing::Not(HasSubstr(">-0<")));
  EXPECT_EQ(svg, ValueMapSvg(map));
}

}  // namespace
}  // namespace penumbra
