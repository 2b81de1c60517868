// display/false_colour.h
//
// Shows values as colours, with a legend.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "display/image.h"

namespace penumbra {

// A colour scale of monotonically increasing lightness: black, blue, violet, orange, yellow, white. `x` is
// clamped to [0, 1].
ScreenColour FalseColour(double x);
// The scale is linear in the codes between this many colours at equal distances: x = i / (kFalseColourStops -
// 1).
inline constexpr int kFalseColourStops = 7;

// Colours every pixel of a surface by FalseColour(mean of its channels / top); `top` has the unit of the
// image. Emitters are white, and the background is dark grey.
void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out);

// A picture of the values of a map in false colours. Values are clamped to [0, 1].
Srgb8Image FalseColours(const std::vector<float>& map, int width, int height);

// Paints a legend in the lower right corner: the scale from 0 to `top`, with the unit above it. Does nothing
// if the picture is smaller than kLegendWidth x kLegendHeight.
void PaintLegend(double top, const std::string& unit, Srgb8Image* picture);
inline constexpr int kLegendWidth = 120, kLegendHeight = 160;  // [pixels]

// A colour for an id, for pictures of ids. Neighbouring numbers have different colours.
ScreenColour ColourOfNumber(std::uint32_t number);

}  // namespace penumbra
