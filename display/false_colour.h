// display/false_colour.h
//
// False colours: shows values as colours, with a legend.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "display/image.h"

namespace penumbra {

// A colour scale of monotonically increasing lightness: black, blue, violet, orange, yellow, white. The
// position `x` on the scale, from black to white, is clamped to [0, 1].
ScreenColour FalseColour(double x);
// The number of colours between which the false-colour scale interpolates linearly in the 8-bit codes. Colour
// i of the false-colour scale lies at x = i / (kFalseColourStops - 1).
inline constexpr int kFalseColourStops = 7;

// Gives each pixel that shows a surface the colour FalseColour((mean of the pixel's channels) / top); `top`
// has the unit of the image. In a false-colour picture, emitters are white, and the background is dark grey.
void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out);

// A picture of a map of values in false colours; values are clamped to [0, 1].
Srgb8Image FalseColours(const std::vector<float>& map, int width, int height);

// Paints a legend in the lower right corner of the picture: the colour scale from 0 to `top`, with the unit
// above the scale. PaintLegend() does nothing if the picture is smaller than kLegendWidth x kLegendHeight.
void PaintLegend(double top, const std::string& unit, Srgb8Image* picture);
inline constexpr int kLegendWidth = 120, kLegendHeight = 160;  // size of the legend [pixels]

// A colour for an id number, for pictures that show triangle ids. Consecutive id numbers have different
// colours.
ScreenColour ColourOfNumber(std::uint32_t number);

}  // namespace penumbra
