// display/false_colour.h
//
// False colours: shows values as colours, with a legend.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "display/image.h"
#include "display/photometry.h"

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

// The values that the ends of the colour scale stand for.
struct FalseColourScale {
  double top = 1;
  LightUnit unit = LightUnit::kWatts;  // the unit of `top`: W/m^2, for the mean of the channels, or lux
  // The scale begins at 0, or, where it is logarithmic, at top / kLogarithmicRange.
  bool logarithmic = false;

  // The place of a value on the scale; it may be outside [0, 1].
  double Place(double value) const;
  // The value at a place from 0 to 1.
  double ValueAt(double place) const;
  double ValueOf(const Rgb& light) const;  // the value of the light in the unit `unit`
};
inline constexpr double kLogarithmicRange = 1000;

// The same as PaintFalseColours() above, by another scale.
void PaintFalseColours(const RgbImage& image, std::span<const PixelKind> kinds, const FalseColourScale& scale,
                       Srgb8Image* out);

// The end of a scale that shows the surfaces of a picture: a round number at or above the 99th percentile of
// their values, so that a few bright points do not darken all the rest; 1 where nothing is lit. Looks at
// every kRangeStride-th pixel of every kRangeStride-th row.
double RangeOf(const RgbImage& image, std::span<const PixelKind> kinds, LightUnit unit);
inline constexpr int kRangeStride = 4;

// A picture of the values of a map in false colours. Values are clamped to [0, 1].
Srgb8Image FalseColours(const std::vector<float>& map, int width, int height);

// Paints a legend in the lower right corner of the picture: the colour scale from 0 to `top`, with the unit
// above the scale. PaintLegend() does nothing if the picture is smaller than kLegendWidth x kLegendHeight.
void PaintLegend(double top, const std::string& unit, Srgb8Image* picture);
// The same for another scale.
void PaintLegend(const FalseColourScale& scale, const std::string& unit, Srgb8Image* picture);
// The size of the legend of a false-colour picture [pixels].
inline constexpr int kLegendWidth = 120, kLegendHeight = 160;

// A colour for an id number, for pictures that show triangle ids. Consecutive id numbers have different
// colours.
ScreenColour ColourOfNumber(std::uint32_t number);

}  // namespace penumbra
