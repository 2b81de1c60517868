// display/image.h
//
// Pictures in memory. The rows of a picture are stored from top to bottom, the pixels of a row from left to
// right.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace penumbra {

// A picture in linear RGB, with one array per channel. The values of an RgbImage are radiosity [W/m^2],
// reflectance [1], or exposed values in [0, 1].
struct RgbImage {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> channel;  // width * height values for each channel

  RgbImage() = default;
  RgbImage(int w, int h) { Resize(w, h); }

  // Changes the size of the picture. If the new size differs from the old size, all pixel values are
  // unspecified afterwards. Memory is allocated only if the number of pixels grows.
  void Resize(int w, int h) {
    width = w;
    height = h;
    for (std::vector<float>& plane : channel) plane.resize(PixelCount());
  }
  std::size_t PixelCount() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  // At() returns the values of a pixel, given by index or by coordinates: x, y and z of the vector are red,
  // green and blue.
  glm::vec3 At(std::size_t i) const { return {channel[0][i], channel[1][i], channel[2][i]}; }
  glm::vec3 At(int x, int y) const { return At(Index(x, y)); }
  void Set(std::size_t i, const glm::vec3& rgb) {
    channel[0][i] = rgb.x;
    channel[1][i] = rgb.y;
    channel[2][i] = rgb.z;
  }
  void Set(int x, int y, const glm::vec3& rgb) { Set(Index(x, y), rgb); }
};

// A picture for a screen: 8-bit sRGB, three bytes per pixel.
struct Srgb8Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> pixels;

  void Resize(int w, int h) {
    width = w;
    height = h;
    pixels.resize(3 * static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
  }
  // The index of pixel (x, y). The three bytes of the pixel begin at pixels[3 * Index(x, y)].
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

struct ScreenColour {
  std::uint8_t red = 0, green = 0, blue = 0;  // 8-bit sRGB codes
};

inline void SetPixel(Srgb8Image* image, std::size_t i, ScreenColour c) {
  image->pixels[3 * i] = c.red;
  image->pixels[3 * i + 1] = c.green;
  image->pixels[3 * i + 2] = c.blue;
}

// The kind of object that a pixel shows. Tone mapping treats each kind of pixel differently.
enum class PixelKind : std::uint8_t { kBackground, kSurface, kEmitter };

// Replaces each block of `across` x `down` pixels by one pixel with the block's mean value (box filter for
// supersampling). REQUIRES: across > 0 divides the width, down > 0 divides the height.
RgbImage Downsample(const RgbImage& image, int across, int down);

}  // namespace penumbra
