// display/false_colour.h
//
// Values as colours, with a scale to read them off.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "display/image.h"

namespace penumbra {

// A colour scale that is told apart in grey, too: black, blue, violet, orange, yellow, white. `x` is clamped
// to [0, 1].
ScreenColour FalseColour(double x);

// Every surface pixel by the mean of its channels, `top` at the end of the scale [unit of the image];
// emitters are white, the background a dark grey.
void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out);

// The values of a map in [0, 1]; larger ones are cut off.
Srgb8Image FalseColours(const std::vector<float>& map, int width, int height);

// The scale in the lower right corner, from 0 to `top`, with the unit above it. Left out where the picture is
// smaller than kLegendWidth x kLegendHeight.
void PaintLegend(double top, const std::string& unit, Srgb8Image* picture);
inline constexpr int kLegendWidth = 120, kLegendHeight = 160;  // [pixels]

// Distinct neighbours get distinct colours: for pictures of numbers.
ScreenColour ColourOfNumber(std::uint32_t number);

}  // namespace penumbra
