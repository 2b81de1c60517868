// display/image.h
//
// Pictures in memory. Rows are stored from top to bottom, pixels from left to right.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace penumbra {

// A picture in linear RGB, one array per channel: radiosity [W/m^2], reflectance [1] or exposed values in [0,
// 1].
struct RgbImage {
  int width = 0, height = 0;
  std::array<std::vector<float>, 3> channel;  // width * height values each

  RgbImage() = default;
  RgbImage(int w, int h) { Resize(w, h); }

  // Changes the size of the picture. If the size differs from the old one, all values are unspecified
  // afterwards. Memory is allocated only if the size grows.
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
  // The values of a pixel, given by its index or by its coordinates: x, y and z of the result are red, green
  // and blue.
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
  // The index of a pixel. The bytes of the pixel begin at pixels[3 * Index(x, y)].
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

struct ScreenColour {
  std::uint8_t red = 0, green = 0, blue = 0;  // sRGB
};

inline void SetPixel(Srgb8Image* image, std::size_t i, ScreenColour c) {
  image->pixels[3 * i] = c.red;
  image->pixels[3 * i + 1] = c.green;
  image->pixels[3 * i + 2] = c.blue;
}

// The kind of object that a pixel shows. Tone mapping treats each kind differently.
enum class PixelKind : std::uint8_t { kBackground, kSurface, kEmitter };

// Replaces each block of `across` x `down` pixels by one pixel, the mean of the block: the box filter of
// supersampling. REQUIRES: across > 0 divides the width, down > 0 divides the height.
RgbImage Downsample(const RgbImage& image, int across, int down);

}  // namespace penumbra
