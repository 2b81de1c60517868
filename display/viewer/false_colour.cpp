#include "display/viewer/false_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "display/tone_mapping.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {
namespace {

// Lightness rises along the scale.
constexpr std::array<Colour, 7> kScale = {{{0, 0, 20},
                                           {30, 20, 110},
                                           {120, 25, 130},
                                           {205, 60, 85},
                                           {245, 130, 30},
                                           {250, 205, 60},
                                           {255, 255, 235}}};

}  // namespace

Colour FalseColour(double x) {
  const double at = std::clamp(x, 0.0, 1.0) * (kScale.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kScale.size() - 2);
  const double t = at - static_cast<double>(i);
  const auto mix = [t](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
  };
  const Colour &a = kScale[i], &b = kScale[i + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out) {
  out->Resize(image.width, image.height);
  const auto grey =
      static_cast<std::uint8_t>(std::lround(255 * SrgbFromLinear(static_cast<double>(kBackground))));
  const auto width = static_cast<std::size_t>(image.width);
  ParallelFor(static_cast<std::size_t>(image.height), 8, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      Colour shown{grey, grey, grey};
      if (kinds[i] == PixelKind::kEmitter) shown = colour::kWhite;
      if (kinds[i] == PixelKind::kSurface) {
        const float sum = image.channel[0][i] + image.channel[1][i] + image.channel[2][i];
        shown = FalseColour(static_cast<double>(sum) / (3 * top));
      }
      out->pixels[3 * i] = shown.red;
      out->pixels[3 * i + 1] = shown.green;
      out->pixels[3 * i + 2] = shown.blue;
    }
  });
}

Colour ColourOfNumber(std::uint32_t number) {
  std::uint32_t h = (number + 1) * 0x9E3779B1U;
  h ^= h >> 15;
  h *= 0x85EBCA77U;
  h ^= h >> 13;
  const auto part = [&](int shift) { return static_cast<std::uint8_t>(64 + ((h >> shift) & 0xff) * 3 / 4); };
  return {part(0), part(8), part(16)};
}

}  // namespace penumbra::viewer
