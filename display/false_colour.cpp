#include "display/false_colour.h"

#include <fmt/format.h>
#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "display/tone_mapping.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// Lightness rises along the scale.
constexpr std::array<ScreenColour, kFalseColourStops> kScale = {{{0, 0, 20},
                                                                 {30, 20, 110},
                                                                 {120, 25, 130},
                                                                 {205, 60, 85},
                                                                 {245, 130, 30},
                                                                 {250, 205, 60},
                                                                 {255, 255, 235}}};

constexpr ScreenColour kWhite{255, 255, 255};

struct Rectangle {
  int x0, y0, x1, y1;  // pixels from, and to but not including
};

// Blends the colour over the part of the rectangle that lies in the picture.
void Fill(Srgb8Image* picture, const Rectangle& r, ScreenColour colour, double opacity) {
  const auto blend = [opacity](std::uint8_t under, std::uint8_t over) {
    return static_cast<std::uint8_t>(std::lround((1 - opacity) * under + opacity * over));
  };
  for (int y = std::max(r.y0, 0); y < std::min(r.y1, picture->height); ++y)
    for (int x = std::max(r.x0, 0); x < std::min(r.x1, picture->width); ++x) {
      const std::size_t i = picture->Index(x, y);
      const std::uint8_t* under = &picture->pixels[3 * i];
      SetPixel(picture, i,
               {blend(under[0], colour.red), blend(under[1], colour.green), blend(under[2], colour.blue)});
    }
}

// Letters are made of rectangles; `scale` enlarges them.
void PaintText(Srgb8Image* picture, int x, int y, int scale, std::string text) {
  struct Corner {
    float x, y, z;
    std::uint8_t colour[4];
  };
  std::vector<Corner> corners(80 * text.size());  // what the font asks for at most
  const int count = stb_easy_font_print(0, 0, text.data(), nullptr, corners.data(),
                                        static_cast<int>(corners.size() * sizeof(Corner)));
  for (int i = 0; i < count; ++i) {
    const Corner *low = &corners[4 * static_cast<std::size_t>(i)], *high = low + 2;
    const auto at = [scale](float value) { return static_cast<int>(std::lround(value)) * scale; };
    Fill(picture, {x + at(low->x), y + at(low->y), x + at(high->x), y + at(high->y)}, kWhite, 1);
  }
}

}  // namespace

ScreenColour FalseColour(double x) {
  const double at = std::clamp(x, 0.0, 1.0) * (kScale.size() - 1);
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(at), kScale.size() - 2);
  const double t = at - static_cast<double>(i);
  const auto mix = [t](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + t * (b - a)));
  };
  const ScreenColour &a = kScale[i], &b = kScale[i + 1];
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

double FalseColourScale::Place(double value) const {
  if (!logarithmic) return value / top;
  return value > 0 ? 1 + std::log(value / top) / std::log(kLogarithmicRange) : 0;
}

double FalseColourScale::ValueAt(double place) const {
  return logarithmic ? top * std::pow(kLogarithmicRange, place - 1) : top * place;
}

double FalseColourScale::ValueOf(const Rgb& light) const {
  return unit == LightUnit::kLux ? Lux(light) : light.mean();
}

double RangeOf(const RgbImage& image, std::span<const PixelKind> kinds, LightUnit unit) {
  const FalseColourScale scale{1, unit};
  std::vector<double> values;
  for (int y = 0; y < image.height; y += kRangeStride)
    for (int x = 0; x < image.width; x += kRangeStride) {
      const std::size_t i = image.Index(x, y);
      if (kinds[i] != PixelKind::kSurface) continue;
      const double value = scale.ValueOf(Rgb(static_cast<double>(image.channel[0][i]),
                                             static_cast<double>(image.channel[1][i]),
                                             static_cast<double>(image.channel[2][i])));
      if (value > 0) values.push_back(value);
    }
  if (values.empty()) return 1;
  constexpr double kKept = 0.99;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(kKept * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  const double decade = std::pow(10, std::floor(std::log10(*at)));
  for (const double round : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (round * decade >= *at) return round * decade;
  return 10 * decade;
}

void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out) {
  PaintFalseColours(image, kinds, FalseColourScale{top}, out);
}

void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, const FalseColourScale& scale,
                       Srgb8Image* out) {
  out->Resize(image.width, image.height);
  const auto grey =
      static_cast<std::uint8_t>(std::lround(255 * SrgbFromLinear(static_cast<double>(kBackground))));
  const auto width = static_cast<std::size_t>(image.width);
  ParallelFor(static_cast<std::size_t>(image.height), 8, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) {
      ScreenColour shown{grey, grey, grey};
      if (kinds[i] == PixelKind::kEmitter) shown = kWhite;
      if (kinds[i] == PixelKind::kSurface) {
        const float r = image.channel[0][i], g = image.channel[1][i], b = image.channel[2][i];
        const double value =
            scale.unit == LightUnit::kLux
                ? Lux(Rgb(static_cast<double>(r), static_cast<double>(g), static_cast<double>(b)))
                : static_cast<double>(r + g + b) / 3;
        shown = FalseColour(scale.Place(value));
      }
      SetPixel(out, i, shown);
    }
  });
}

Srgb8Image FalseColours(const std::vector<float>& map, int width, int height) {
  Srgb8Image image;
  image.Resize(width, height);
  for (std::size_t i = 0; i < map.size(); ++i) SetPixel(&image, i, FalseColour(static_cast<double>(map[i])));
  return image;
}

void PaintLegend(double top, const std::string& unit, Srgb8Image* picture) {
  PaintLegend(FalseColourScale{top}, unit, picture);
}

void PaintLegend(const FalseColourScale& scale_of_values, const std::string& unit, Srgb8Image* picture) {
  if (picture->width < kLegendWidth || picture->height < kLegendHeight) return;
  constexpr int kRows = 540;  // of a picture for which letters are drawn as they are
  const int scale = std::clamp(picture->height / kRows, 1, 8);
  const int width = 14 * scale, height = 100 * scale, line = 12 * scale;
  const int x = picture->width - 80 * scale, y = picture->height - height - 16 * scale;
  Fill(picture, {x - 8 * scale, y - 2 * line, picture->width, picture->height}, {20, 20, 20}, 0.75);
  PaintText(picture, x, y - line - 6 * scale, scale, unit);
  for (int row = 0; row < height; ++row)
    Fill(picture, {x, y + row, x + width, y + row + 1}, FalseColour(1 - (row + 0.5) / height), 1);
  constexpr int kTicks = 4;
  for (int i = 0; i <= kTicks; ++i) {
    const int at = y + height - height * i / kTicks;
    Fill(picture, {x + width, at - (scale + 1) / 2, x + width + 4 * scale, at + scale / 2}, kWhite, 1);
    PaintText(picture, x + width + 8 * scale, at - 4 * scale, scale,
              fmt::format("{:.3g}", scale_of_values.ValueAt(static_cast<double>(i) / kTicks)));
  }
}

ScreenColour ColourOfNumber(std::uint32_t number) {
  std::uint32_t h = (number + 1) * 0x9E3779B1U;
  h ^= h >> 15;
  h *= 0x85EBCA77U;
  h ^= h >> 13;
  const auto part = [&](int shift) { return static_cast<std::uint8_t>(64 + ((h >> shift) & 0xff) * 3 / 4); };
  return {part(0), part(8), part(16)};
}

}  // namespace penumbra
