// display/viewer/false_colour.h

#pragma once

#include <span>

#include "display/image.h"
#include "display/viewer/overlay_drawing.h"

namespace penumbra::viewer {

// A colour scale that is told apart in grey, too: black, blue, violet, orange, yellow, white. `x` is clamped
// to [0, 1].
Colour FalseColour(double x);

// Every surface pixel by the mean of its channels, `top` at the end of the scale [unit of the image];
// emitters are white, the background a dark grey.
void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, double top, Srgb8Image* out);

// Distinct neighbours get distinct colours: for pictures of numbers.
Colour ColourOfNumber(std::uint32_t number);

}  // namespace penumbra::viewer
