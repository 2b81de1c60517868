#include "display/false_colour.h"

#include <gtest/gtest.h>

#include <cmath>

#include "display/tone_mapping.h"

namespace penumbra {
namespace {

// Linear luminance (ITU-R BT.709).
double LuminanceOf(ScreenColour c) {
  return 0.2126 * LinearFromSrgb(c.red / 255.0) + 0.7152 * LinearFromSrgb(c.green / 255.0) +
         0.0722 * LinearFromSrgb(c.blue / 255.0);
}

ScreenColour At(const Srgb8Image& image, int x, int y) {
  const std::size_t i =
      3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  return {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]};
}

// A larger value is never darker: the scale reads in grey, too.
TEST(FalseColour, GrowsLighter) {
  for (int i = 1; i <= 256; ++i)
    EXPECT_GE(LuminanceOf(FalseColour(i / 256.0)), LuminanceOf(FalseColour((i - 1) / 256.0)) - 1e-4) << i;
}

// A surface pixel is coloured by its mean against the top of the scale; lights are white, whatever they emit.
TEST(FalseColour, ShowsTheMeanOfTheChannels) {
  RgbImage image(2, 1);
  image.Set(0, 0, {1, 2, 6});
  image.Set(1, 0, {1, 1, 1});
  Srgb8Image out;
  PaintFalseColours(image, std::vector{PixelKind::kSurface, PixelKind::kEmitter}, 12, &out);
  EXPECT_EQ(At(out, 0, 0).red, FalseColour(0.25).red);
  EXPECT_EQ(At(out, 0, 0).blue, FalseColour(0.25).blue);
  EXPECT_EQ(At(out, 1, 0).red, 255);
  EXPECT_EQ(At(out, 1, 0).blue, 255);
}

// The legend runs through the whole scale, upwards, writes beside it, leaves the rest of the picture alone,
// and all of a picture that is too small.
TEST(FalseColour, LegendShowsTheScale) {
  for (const int scale : {1, 2}) {
    Srgb8Image picture;
    picture.Resize(400 * scale, 600 * scale);
    PaintLegend(250, "W/m^2", &picture);
    int last = -1, steps = 0, white = 0;
    const int column = picture.width - 80 * scale + 1;
    for (int y = picture.height - 16 * scale - 1; y >= picture.height - 116 * scale; --y) {
      const int blue_free = At(picture, column, y).red;
      EXPECT_GE(blue_free, last);
      steps += blue_free != last;
      last = blue_free;
    }
    EXPECT_GT(steps, 50);
    EXPECT_EQ(last, FalseColour(1 - 0.5 / (100 * scale)).red);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const bool inside = x >= picture.width - 88 * scale && y >= picture.height - 140 * scale;
        if (!inside) {
          ASSERT_EQ(At(picture, x, y).red + At(picture, x, y).green + At(picture, x, y).blue, 0);
        }
        white += inside && x > column + 18 * scale && At(picture, x, y).green == 255;
      }
    EXPECT_GT(white, 100 * scale * scale);  // digits
  }
  Srgb8Image small;
  small.Resize(40, 30);
  PaintLegend(250, "W/m^2", &small);
  for (const std::uint8_t value : small.pixels) EXPECT_EQ(value, 0);
}

}  // namespace
}  // namespace penumbra
