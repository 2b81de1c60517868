// display/tone_mapping.h
//
// Tone mapping converts linear radiosity to a picture for the screen.
//
// A pixel's radiosity [W/m^2] is multiplied by the exposure [m^2/W] and clipped at 1. In a picture for the
// screen, emitters are white. The background of a picture is dark grey, so that it differs from unlit
// surfaces, which are black. The exposed value is encoded by the sRGB transfer function (IEC 61966-2-1) and
// rounded to an 8-bit code, by default with an ordered dither of less than half a code in either direction.
// Without dither, slow gradients of irradiance are visible as bands. The dither depends on the pixel's
// position only, and does not change values that are exact codes (black, white).

#pragma once

#include <span>

#include "display/image.h"

namespace penumbra {

// The linear value of background pixels.
inline constexpr float kBackground = 0.012f;

// SrgbFromLinear() is the sRGB transfer function for values in [0, 1]; LinearFromSrgb() is its inverse.
// SrgbFromLinear() and LinearFromSrgb() are exact up to rounding.
double SrgbFromLinear(double linear);
double LinearFromSrgb(double encoded);

struct ToneMapping {
  // factor that converts values of the image to linear screen values; [m^2/W] for images of radiosity
  double exposure = 1;
  bool dither = true;  // false: each value is rounded to the nearest 8-bit code
};

// Determines an exposure that suits an image: after exposure, the largest channel is at most kMeteredValue in
// a fraction kMeteredFraction of the pixels of kind kSurface. Pixels of emitters and of the background are
// ignored. MeterExposure() returns 1 if every surface pixel is black. REQUIRES: kinds.size() ==
// image.PixelCount().
double MeterExposure(const RgbImage& image, std::span<const PixelKind> kinds);
inline constexpr double kMeteredFraction = 0.97;
inline constexpr double kMeteredValue = 0.9;

// The exposed image, with linear values in [0, 1], white emitters and grey background. Each pixel of the
// exposed image is the mean of a block of across x down exposed pixels of `image`. Because supersampled
// pictures are averaged after clipping and before the sRGB transfer, the edges of lights are smooth.
// REQUIRES: across > 0 divides the width, down > 0 divides the height.
RgbImage Expose(const RgbImage& image, std::span<const PixelKind> kinds, double exposure, int across = 1,
                int down = 1);

// The 8 x 8 offsets of the ordered dither, row by row; each offset is in (0, 1). The 8-bit code of pixel (x,
// y) is floor(255 * encoded value + offset), with the offset in row y % 8 and column x % 8.
const float* DitherOffsets();

// Converts an exposed image to 8-bit sRGB.
void EncodeSrgb(const RgbImage& exposed, bool dither, Srgb8Image* out);

// A picture in which each pixel is the mean of k x k pixels of `screen`; the mean is that of linear values.
// REQUIRES: k > 0 divides width and height.
Srgb8Image ShrinkScreen(const Srgb8Image& screen, int k);

// Does the same as Expose() followed by EncodeSrgb(), in one pass over the pixels. ToneMap() reuses the
// memory of `out`.
void ToneMap(const RgbImage& image, std::span<const PixelKind> kinds, const ToneMapping& settings,
             Srgb8Image* out);

}  // namespace penumbra
