// display/tone_mapping.h
//
// From linear radiosity to what a screen shows.
//
// A pixel's radiosity [W/m^2] is multiplied by the exposure [m^2/W] and cut off at 1; emitters are white and
// the background is a dark grey, so that unlit surfaces and places where nothing is are told apart. Then the
// sRGB transfer (IEC 61966-2-1) and rounding to 8 bits, by default with an ordered dither of less than half a
// code either way: the slow gradients of irradiance would otherwise show as bands. The dither is fixed to the
// picture's grid, and values that are exact codes (black, white) are not touched by it.

#pragma once

#include <span>

#include "display/image.h"

namespace penumbra {

// What pixels without a surface show, linear.
inline constexpr float kBackground = 0.012f;

// The sRGB transfer of a linear value in [0, 1], exact to rounding, and its inverse.
double SrgbFromLinear(double linear);
double LinearFromSrgb(double encoded);

struct ToneMapping {
  double exposure = 1;  // screen value in [0, 1] per unit of the image, e.g. [m^2/W]
  bool dither = true;   // false: round to the nearest code
};

// The exposure that brings a bright surface of the picture, kMeteredFraction of all surface pixels in order
// of their largest channel, to kMeteredValue; emitters and background do not count. 1 if no surface pixel is
// lit. REQUIRES: kinds.size() == image.PixelCount().
double MeterExposure(const RgbImage& image, std::span<const PixelKind> kinds);
inline constexpr double kMeteredFraction = 0.97;
inline constexpr double kMeteredValue = 0.9;

// The image exposed, emitters white, background grey: linear, in [0, 1]. Supersampled pictures are averaged
// here, between exposure and transfer, so that the edges of lights are smooth: then a pixel is the mean of
// across x down, and no memory is taken for them. REQUIRES: across > 0 divides width, down > 0 height.
RgbImage Expose(const RgbImage& image, std::span<const PixelKind> kinds, double exposure, int across = 1,
                int down = 1);

// The dither's 8 x 8 offsets in (0, 1), row by row: what is added to 255 times the encoded value before it is
// rounded down. Pixel (x, y) takes row y % 8, column x % 8.
const float* DitherOffsets();

// An exposed image in 8-bit sRGB.
void EncodeSrgb(const RgbImage& exposed, bool dither, Srgb8Image* out);

// A screen with k x k pixels in the place of each, averaged in linear light. REQUIRES: k > 0 divides width
// and height.
Srgb8Image ShrinkScreen(const Srgb8Image& screen, int k);

// Expose and EncodeSrgb in one go, reusing the memory of `out`.
void ToneMap(const RgbImage& image, std::span<const PixelKind> kinds, const ToneMapping& settings,
             Srgb8Image* out);

}  // namespace penumbra
