// display/tone_mapping.h
//
// Converts linear radiosity to a picture for the screen.
//
// A pixel's radiosity [W/m^2] is multiplied by the exposure [m^2/W] and clipped at 1. Emitters are white. The
// background is dark grey, to distinguish it from unlit surfaces. Then follow the sRGB transfer (IEC
// 61966-2-1) and rounding to 8 bits, by default with an ordered dither of less than half a code in either
// direction; without dither the slow gradients of irradiance show as bands. The dither depends on the pixel's
// position only, and does not change values that are exact codes (black, white).

#pragma once

#include <span>

#include "display/image.h"

namespace penumbra {

// The linear value of background pixels.
inline constexpr float kBackground = 0.012f;

// The sRGB transfer function for a linear value in [0, 1], exact to rounding, and its inverse.
double SrgbFromLinear(double linear);
double LinearFromSrgb(double encoded);

struct ToneMapping {
  double exposure = 1;  // screen value in [0, 1] per unit of the image; for radiosity [m^2/W]
  bool dither = true;   // false: round to the nearest code
};

// The exposure that suits an image: kMeteredFraction of the pixels that show reflecting surfaces become no
// brighter than kMeteredValue, by their largest channel. Pixels of emitters and of the background do not
// count. Returns 1 if every surface pixel is black. REQUIRES: kinds.size() == image.PixelCount().
double MeterExposure(const RgbImage& image, std::span<const PixelKind> kinds);
inline constexpr double kMeteredFraction = 0.97;
inline constexpr double kMeteredValue = 0.9;

// The exposed image, linear, in [0, 1], with white emitters and grey background. Each pixel is the mean of a
// block of across x down pixels of `image`: supersampled pictures are averaged between exposure and transfer,
// so that the edges of lights are smooth. REQUIRES: across > 0 divides the width, down > 0 divides the
// height.
RgbImage Expose(const RgbImage& image, std::span<const PixelKind> kinds, double exposure, int across = 1,
                int down = 1);

// The 8 x 8 offsets of the dither in (0, 1), row by row. The offset in row y % 8, column x % 8 is added to
// 255 * (encoded value of pixel (x, y)) before rounding down.
const float* DitherOffsets();

// Converts an exposed image to 8-bit sRGB.
void EncodeSrgb(const RgbImage& exposed, bool dither, Srgb8Image* out);

// A picture in which each pixel is the mean of k x k pixels of `screen`, in linear light. REQUIRES: k > 0
// divides width and height.
Srgb8Image ShrinkScreen(const Srgb8Image& screen, int k);

// Expose() and EncodeSrgb() in one pass; reuses the memory of `out`.
void ToneMap(const RgbImage& image, std::span<const PixelKind> kinds, const ToneMapping& settings,
             Srgb8Image* out);

}  // namespace penumbra
