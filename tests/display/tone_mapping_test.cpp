#include "display/tone_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iostream>
#include <utility>

#include "display/vector_kernels.h"

namespace penumbra {
namespace {

std::uint8_t NearestCode(float x) {
  return static_cast<std::uint8_t>(std::floor(255 * SrgbFromLinear(static_cast<double>(x)) + 0.5));
}

std::vector<std::uint8_t> Encode(const std::vector<float>& values, const float* dither) {
  std::vector<std::uint32_t> codes(values.size());
  EncodeRow(values.data(), values.data(), values.data(), values.size(), dither, codes.data());
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t code : codes) {
    bytes.push_back(static_cast<std::uint8_t>(code & 255));
    EXPECT_EQ(code, (code & 255) * 0x10101) << "channels are alike";
  }
  return bytes;
}

// Without dither every float gets the code that is nearest to its sRGB encoding: all floats on both sides of
// each of the 255 thresholds, and floats all over [0, 1].
TEST(ToneMapping, RoundsToTheNearestCode) {
  std::vector<float> values = {0.0f, 1.0f, 0.0031308f, std::nextafter(0.0031308f, 1.0f), 1e-40f};
  for (int k = 1; k <= 255; ++k) {
    const auto threshold = static_cast<float>(LinearFromSrgb((k - 0.5) / 255));
    const auto bits = std::bit_cast<std::int32_t>(threshold);
    for (std::int32_t i = -200; i <= 200; ++i) values.push_back(std::bit_cast<float>(bits + i));
  }
  for (std::int32_t bits = std::bit_cast<std::int32_t>(1e-5f); bits < std::bit_cast<std::int32_t>(1.0f);
       bits += 997)
    values.push_back(std::bit_cast<float>(bits));
  const std::vector<std::uint8_t> codes = Encode(values, nullptr);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_EQ(codes[i], NearestCode(values[i])) << values[i];
  std::cout << values.size() << " values\n";
}

// Dithered, a value's code is one of the two about its encoding; over the 64 offsets its mean is the encoding
// to 1/64 of a code; and what is a code itself, black and white among them, is not touched.
TEST(ToneMapping, DithersWithoutBias) {
  double worst = 0;
  for (int step = 0; step <= 2000; ++step) {
    const auto x = static_cast<float>(std::pow(step / 2000.0, 2.2));
    const double exact = 255 * SrgbFromLinear(static_cast<double>(x));
    double sum = 0;
    for (int y = 0; y < 8; ++y)
      for (const std::uint8_t code : Encode(std::vector<float>(8, x), DitherOffsets() + 8 * y)) {
        EXPECT_LE(std::abs(code - exact), 1);
        sum += code;
      }
    worst = std::max(worst, std::abs(sum / 64 - exact));
  }
  std::cout << "largest bias " << worst << " of a code\n";
  EXPECT_LT(worst, 1.0 / 64 + 1e-3);
  for (int k = 0; k <= 255; ++k) {
    const auto x = static_cast<float>(LinearFromSrgb(k / 255.0));
    for (int y = 0; y < 8; ++y)
      for (const std::uint8_t code : Encode(std::vector<float>(13, x), DitherOffsets() + 8 * y))
        EXPECT_EQ(code, k);
  }
}

// Emitters are white and the background grey whatever the exposure; surfaces are exposed and cut off at 1.
TEST(ToneMapping, ExposesSurfacesOnly) {
  RgbImage image(4, 1);
  image.Set(0, 0, {0.5f, 1.0f, 3.0f});
  image.Set(1, 0, {0.1f, 0.0f, 0.1f});
  const std::vector<PixelKind> kinds = {PixelKind::kSurface, PixelKind::kEmitter, PixelKind::kBackground,
                                        PixelKind::kSurface};
  image.Set(3, 0, {0.0f, 0.0f, 0.0f});
  const RgbImage exposed = Expose(image, kinds, 0.5);
  EXPECT_EQ(exposed.At(0, 0), (glm::vec3{0.25f, 0.5f, 1.0f}));
  EXPECT_EQ(exposed.At(1, 0), (glm::vec3{1, 1, 1}));
  EXPECT_EQ(exposed.At(2, 0), (glm::vec3{kBackground, kBackground, kBackground}));
  EXPECT_EQ(exposed.At(3, 0), (glm::vec3{0, 0, 0}));
}

// A supersampled picture is the mean of its samples exposed, to the bit; one that was encoded before is
// shrunk in the same way.
TEST(ToneMapping, AveragesWhatIsExposed) {
  constexpr int kWidth = 600, kHeight = 42;
  RgbImage image(kWidth, kHeight);
  std::vector<PixelKind> kinds(image.PixelCount(), PixelKind::kSurface);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const auto at = static_cast<float>(x + 7 * y);
      image.Set(x, y, {0.01f * at, 1 / (1 + at), 0.5f + 0.4f * std::sin(at)});
      if ((x + y) % 13 == 0) kinds[image.Index(x, y)] = PixelKind::kEmitter;
      if ((x - y) % 17 == 0) kinds[image.Index(x, y)] = PixelKind::kBackground;
    }
  for (const auto& [across, down] : {std::pair(2, 2), {3, 7}, {1, 1}, {6, 1}}) {
    const RgbImage means = Expose(image, kinds, 0.8, across, down);
    EXPECT_EQ(means.width, kWidth / across);
    EXPECT_EQ(means.height, kHeight / down);
    EXPECT_EQ(means.channel, Downsample(Expose(image, kinds, 0.8), across, down).channel);
  }
  Srgb8Image screen, shrunk;
  EncodeSrgb(Expose(image, kinds, 0.8), true, &screen);
  RgbImage linear(kWidth, kHeight);
  for (std::size_t i = 0; i < screen.pixels.size(); ++i)
    linear.channel[i % 3][i / 3] =
        static_cast<float>(LinearFromSrgb(static_cast<double>(screen.pixels[i]) / 255));
  EncodeSrgb(Downsample(linear, 3, 3), false, &shrunk);
  EXPECT_EQ(ShrinkScreen(screen, 3).pixels, shrunk.pixels);
}

// Three bytes a pixel, whatever the number of pixels.
TEST(ToneMapping, PacksRows) {
  for (const std::size_t n : {0, 1, 2, 3, 4, 5, 63, 64, 65, 67, 128, 200}) {
    std::vector<std::uint32_t> codes(n);
    for (std::size_t i = 0; i < n; ++i)
      codes[i] = static_cast<std::uint32_t>((3 * i + 1) % 251 + ((3 * i + 2) % 251 << 8) +
                                            ((3 * i + 3) % 251 << 16));
    std::vector<std::uint8_t> bytes(3 * n + 1, 255);
    PackRow(codes.data(), n, bytes.data());
    for (std::size_t i = 0; i < 3 * n; ++i) EXPECT_EQ(bytes[i], (i + 1) % 251) << n;
    EXPECT_EQ(bytes[3 * n], 255) << n;
  }
}

}  // namespace
}  // namespace penumbra
