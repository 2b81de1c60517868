#include "display/tone_mapping.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "display/vector_kernels.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kRowsPerTask = 8;
constexpr std::size_t kRun =
    512;  // pixels that are encoded at a time; a multiple of 8, the period of the dither

// Calls body(first pixel, pixels, dither) for runs of at most kRun pixels of every row, in parallel.
template <class Body>
void ForEachPixelRun(int width, int height, bool dither, const Body& body) {
  ParallelFor(static_cast<std::size_t>(height), kRowsPerTask, [&](std::size_t y) {
    const float* offsets = dither ? DitherOffsets() + 8 * (y % 8) : nullptr;
    const auto across = static_cast<std::size_t>(width);
    for (std::size_t x = 0; x < across; x += kRun) body(y * across + x, std::min(kRun, across - x), offsets);
  });
}

// What Downsample() makes of a picture whose rows are computed when they are needed: fill(y, rows) gives
// those from y on.
template <class Fill>
RgbImage AverageRows(int width, int height, int across, int down, const Fill& fill) {
  PENUMBRA_CHECK(across > 0 && width % across == 0 && down > 0 && height % down == 0);
  RgbImage means(width / across, height / down);
  ParallelFor(static_cast<std::size_t>(means.height), 1, [&](std::size_t row) {
    RgbImage rows(width, down);
    fill(static_cast<int>(row) * down, &rows);
    const RgbImage mean = Downsample(rows, across, down);
    for (std::size_t c = 0; c < 3; ++c)
      std::copy(mean.channel[c].begin(), mean.channel[c].end(),
                means.channel[c].data() + means.Index(0, static_cast<int>(row)));
  });
  return means;
}

// Encodes three planes of n <= kRun values into interleaved bytes.
void EncodeRun(const std::array<const float*, 3>& exposed, const float* dither, std::size_t n,
               std::uint8_t* out) {
  std::array<std::uint32_t, kRun> codes;
  EncodeRow(exposed[0], exposed[1], exposed[2], n, dither, codes.data());
  PackRow(codes.data(), n, out);
}

}  // namespace

// Bayer's matrix, as fractions of a code in (-1/2, 1/2) about the half that rounds to the nearest.
const float* DitherOffsets() {
  static const std::array<float, 64> offsets = [] {
    std::array<float, 64> made{};
    for (std::size_t i = 0; i < made.size(); ++i) {
      const std::size_t x = i % 8, y = i / 8;
      std::size_t rank = 0;
      for (std::size_t bit = 0; bit < 3; ++bit) {
        const std::size_t bx = (x >> bit) & 1, by = (y >> bit) & 1;
        rank = 4 * rank + 2 * (bx ^ by) + by;
      }
      made[i] = 0.5f + (static_cast<float>(rank) - 31.5f) / 64;
    }
    return made;
  }();
  return offsets.data();
}

double SrgbFromLinear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

double LinearFromSrgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double MeterExposure(const RgbImage& image, std::span<const PixelKind> kinds) {
  PENUMBRA_CHECK(kinds.size() == image.PixelCount());
  std::vector<float> brightest;
  brightest.reserve(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i)
    if (kinds[i] == PixelKind::kSurface)
      brightest.push_back(std::max({image.channel[0][i], image.channel[1][i], image.channel[2][i]}));
  if (brightest.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(kMeteredFraction * static_cast<double>(brightest.size() - 1));
  std::nth_element(brightest.begin(), brightest.begin() + rank, brightest.end());
  double metered = static_cast<double>(brightest[static_cast<std::size_t>(rank)]);
  // Where fewer pixels than that are lit, the brightest one decides.
  if (!(metered > 0)) metered = static_cast<double>(*std::max_element(brightest.begin(), brightest.end()));
  const double exposure = kMeteredValue / metered;
  return metered > 0 && std::isfinite(exposure) ? exposure : 1;
}

RgbImage Expose(const RgbImage& image, std::span<const PixelKind> kinds, double exposure, int across,
                int down) {
  PENUMBRA_CHECK(kinds.size() == image.PixelCount());
  return AverageRows(image.width, image.height, across, down, [&](int y, RgbImage* rows) {
    const std::size_t first = image.Index(0, y);
    for (std::size_t c = 0; c < 3; ++c)
      ExposeRow(image.channel[c].data() + first, kinds.data() + first, static_cast<float>(exposure),
                kBackground, rows->PixelCount(), rows->channel[c].data());
  });
}

void EncodeSrgb(const RgbImage& exposed, bool dither, Srgb8Image* out) {
  out->Resize(exposed.width, exposed.height);
  ForEachPixelRun(
      exposed.width, exposed.height, dither, [&](std::size_t at, std::size_t n, const float* offsets) {
        const auto& [r, g, b] = exposed.channel;
        EncodeRun({r.data() + at, g.data() + at, b.data() + at}, offsets, n, out->pixels.data() + 3 * at);
      });
}

void ToneMap(const RgbImage& image, std::span<const PixelKind> kinds, const ToneMapping& settings,
             Srgb8Image* out) {
  PENUMBRA_CHECK(kinds.size() == image.PixelCount());
  out->Resize(image.width, image.height);
  ForEachPixelRun(image.width, image.height, settings.dither,
                  [&](std::size_t at, std::size_t n, const float* offsets) {
                    std::array<std::array<float, kRun>, 3> exposed;
                    for (std::size_t c = 0; c < 3; ++c)
                      ExposeRow(image.channel[c].data() + at, kinds.data() + at,
                                static_cast<float>(settings.exposure), kBackground, n, exposed[c].data());
                    EncodeRun({exposed[0].data(), exposed[1].data(), exposed[2].data()}, offsets, n,
                              out->pixels.data() + 3 * at);
                  });
}

Srgb8Image ShrinkScreen(const Srgb8Image& screen, int k) {
  std::array<float, 256> value;
  for (std::size_t code = 0; code < value.size(); ++code)
    value[code] = static_cast<float>(LinearFromSrgb(static_cast<double>(code) / 255));
  Srgb8Image out;
  EncodeSrgb(AverageRows(screen.width, screen.height, k, k,
                         [&](int y, RgbImage* rows) {
                           const std::uint8_t* pixel = screen.pixels.data() + 3 * screen.Index(0, y);
                           for (std::size_t i = 0; i < rows->PixelCount(); ++i, pixel += 3)
                             for (std::size_t c = 0; c < 3; ++c) rows->channel[c][i] = value[pixel[c]];
                         }),
             false, &out);
  return out;
}

}  // namespace penumbra
