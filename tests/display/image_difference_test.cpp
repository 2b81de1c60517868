// The numbers of relative errors, and what FLIP says where its formulas can be worked out by hand.

#include "display/image_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "display/flip.h"
#include "solver/base/random.h"

namespace penumbra {
namespace {

RgbImage Uniform(int width, int height, const glm::vec3& rgb) {
  RgbImage image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.Set(x, y, rgb);
  return image;
}

RgbImage Noise(int width, int height, std::uint64_t seed) {
  Random random(seed);
  RgbImage image(width, height);
  for (auto& plane : image.channel)
    for (float& value : plane) value = static_cast<float>(random.Uniform());
  return image;
}

// Two of a hundred pixels off, by 50 % and by 100 %; the percentiles fall between.
TEST(RelativeErrors, AreCountedByHand) {
  const RgbImage a = Uniform(10, 10, {2, 4, 0});
  RgbImage b = a;
  b.Set(3, 3, {3, 4, 0});
  b.Set(4, 3, {4, 4, 0});
  const auto errors = RelativeErrors(a, b);
  EXPECT_DOUBLE_EQ(errors[0].max, 1);
  EXPECT_DOUBLE_EQ(errors[0].p99, 0.5);
  EXPECT_DOUBLE_EQ(errors[0].p95, 0);
  EXPECT_DOUBLE_EQ(errors[0].rms, std::sqrt((0.25 + 1) / 100));
  EXPECT_DOUBLE_EQ(errors[0].mean_ratio, 203.0 / 200);
  for (std::size_t c : {1U, 2U}) {
    EXPECT_EQ(errors[c].max, 0);
    EXPECT_EQ(errors[c].mean_ratio, 1);
  }
  // In the dark the error is measured by the mean.
  RgbImage dark = a;
  dark.Set(0, 0, {0, 4, 0});
  EXPECT_NEAR(RelativeErrors(dark, a)[0].max, 2 / (kDarkest * 1.98), 1e-6);
}

// Colour spaces lead back where they came from, white is 100 and has no colour.
TEST(Flip, ColourSpacesAreConsistent) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Colour rgb = {random.Uniform(), random.Uniform(), random.Uniform()};
    const Colour back = LinearFromOpponent(OpponentFromLinear(rgb));
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back[c], rgb[c], 1e-12);
  }
  const Colour white = HuntLab({1, 1, 1}), black = HuntLab({0, 0, 0});
  EXPECT_NEAR(white[0], 100, 1e-12);
  EXPECT_NEAR(white[1], 0, 1e-12);
  EXPECT_NEAR(white[2], 0, 1e-12);
  EXPECT_NEAR(black[0], 0, 1e-12);
  EXPECT_NEAR(Luminance({1, 1, 1}), 1, 1e-12);
  EXPECT_NEAR(HyAb(white, black), 100, 1e-12);
}

// Nothing differs from itself; the difference is symmetric and within [0, 1].
TEST(Flip, IsSymmetricAndBounded) {
  const RgbImage a = Noise(64, 48, 1), b = Noise(64, 48, 2);
  for (const float value : FlipOfExposed(a, a)) ASSERT_EQ(value, 0);
  const std::vector<float> ab = FlipOfExposed(a, b), ba = FlipOfExposed(b, a);
  EXPECT_EQ(ab, ba);
  for (const float value : ab) {
    ASSERT_GE(value, 0);
    ASSERT_LE(value, 1);
  }
}

// Uniform pictures have no features: what is left is the compressed difference of their colours. Green and
// blue are as far apart as colours can be; white and black differ by a lightness of 100.
TEST(Flip, OfUniformPicturesIsThatOfTheirColours) {
  const RgbImage green = Uniform(40, 30, {0, 1, 0}), blue = Uniform(40, 30, {0, 0, 1}),
                 white = Uniform(40, 30, {1, 1, 1}), black = Uniform(40, 30, {0, 0, 0});
  constexpr double kFloats = 1e-4;  // filters in floats, magnified by the power 0.7 of small differences
  for (const float value : FlipOfExposed(green, blue)) ASSERT_NEAR(value, 1, kFloats);
  const double largest = std::pow(HyAb(HuntLab({0, 1, 0}), HuntLab({0, 0, 1})), 0.7);
  const double want = 0.95 + 0.05 * (std::pow(100, 0.7) - 0.4 * largest) / (0.6 * largest);
  for (const float value : FlipOfExposed(white, black)) ASSERT_NEAR(value, want, kFloats);
  // Greys: lightness alone, below the knee.
  const RgbImage one = Uniform(40, 30, {0.5F, 0.5F, 0.5F}), other = Uniform(40, 30, {0.6F, 0.6F, 0.6F});
  const double lightness = 116 * (std::cbrt(0.6) - std::cbrt(0.5));
  const double grey = 0.95 * std::pow(lightness, 0.7) / (0.4 * largest);
  for (const float value : FlipOfExposed(one, other)) ASSERT_NEAR(value, grey, kFloats);
}

// A balanced filter answers a step with 1 beside it, and a constant with 0.
TEST(Flip, FilterIsAConvolutionWithoutBorders) {
  const Kernel across{{0.25F, 0.5F, 0.25F}}, down{{1.0F}};
  std::vector<float> plane = {0, 0, 4, 0, 0, 8, 8, 8, 8, 8};
  EXPECT_EQ(Filter(plane, 5, 2, across, down), (std::vector<float>{0, 1, 2, 1, 0, 8, 8, 8, 8, 8}));
  EXPECT_EQ(Filter(plane, 5, 2, down, Kernel{{1.0F, 0.0F, -1.0F}}),
            (std::vector<float>{-8, -8, -4, -8, -8, -8, -8, -4, -8, -8}));
}

// A sharp line is seen better than the same change spread out, and from farther away less well than from near
// by.
TEST(Flip, SeesAsAnEyeDoes) {
  const RgbImage grey = Uniform(120, 60, {0.3F, 0.3F, 0.3F});
  RgbImage line = grey, smooth = grey;
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 120; ++x) {
      const float sharp = x >= 56 && x < 64 ? 0.1F : 0.0F;
      const float soft = 0.8F / 120;  // the same amount in all
      line.Set(x, y, {0.3F + sharp, 0.3F + sharp, 0.3F + sharp});
      smooth.Set(x, y, {0.3F + soft, 0.3F + soft, 0.3F + soft});
    }
  const double near_by = FindVisibleDifference(grey, line, 30).mean,
               far_off = FindVisibleDifference(grey, line, 240).max;
  EXPECT_GT(FindVisibleDifference(grey, line).max, 3 * FindVisibleDifference(grey, smooth).max);
  EXPECT_GT(near_by, 0);
  EXPECT_LT(far_off, FindVisibleDifference(grey, line, 30).max);
}

// A common factor changes nothing but the exposures: pictures of any range are judged alike.
TEST(Flip, OfAnyRangeKnowsNoUnit) {
  RgbImage a = Noise(48, 32, 5), b = Noise(48, 32, 6);
  const VisibleDifference before = FindVisibleDifference(a, b);
  constexpr float kFactor = 1024;
  for (RgbImage* image : {&a, &b})
    for (auto& plane : image->channel)
      for (float& value : plane) value *= kFactor;
  const VisibleDifference after = FindVisibleDifference(a, b);
  ASSERT_EQ(before.map.size(), after.map.size());
  for (std::size_t i = 0; i < before.map.size(); ++i) ASSERT_NEAR(before.map[i], after.map[i], 1e-5);
  EXPECT_NEAR(before.exposures[0], kFactor * after.exposures[0], 1e-9 * before.exposures[0]);
  EXPECT_EQ(FindVisibleDifference(a, a).max, 0);
  const RgbImage dark = Uniform(8, 8, {0, 0, 0});
  EXPECT_EQ(FindVisibleDifference(dark, dark).max, 0);
}

// How far it is, is told exposure by exposure up to the end; cancelled, it ends early.
TEST(VisibleDifference, TellsHowFarItIs) {
  const RgbImage a = Noise(40, 30, 6), b = Noise(40, 30, 7);
  std::vector<double> told;
  ExecutionContext context([&](std::string_view, double fraction) { told.push_back(fraction); });
  const VisibleDifference whole = FindVisibleDifference(a, b, kPixelsPerDegree, context);
  ASSERT_EQ(told.size(), whole.exposures.size());
  for (std::size_t i = 0; i < told.size(); ++i)
    EXPECT_DOUBLE_EQ(told[i], static_cast<double>(i + 1) / static_cast<double>(told.size()));
  context.Cancel();
  FindVisibleDifference(a, b, kPixelsPerDegree, context);
  EXPECT_EQ(told.size(), whole.exposures.size());
}

}  // namespace
}  // namespace penumbra
