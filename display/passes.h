// display/passes.h
//
// The interface of the two passes of the display, which draw triangle ids and barycentric coordinates for
// each pixel (thesis 3.4.1 and 3.4.2).

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "display/camera.h"

namespace penumbra {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;
inline constexpr int kMaxPictureSize = 32768;  // largest width and height of a picture [pixels]

using VertexIndices = std::array<std::uint32_t, 3>;

class Passes {
 public:
  virtual ~Passes() = default;

  // Pass 1: sets ids[y * width + x] to the index of the triangle that is visible at the centre of pixel (x,
  // y), or to kNoTriangle. REQUIRES: ids.size() == width * height; 0 < width, height <= kMaxPictureSize.
  virtual void DrawTriangleIds(const PixelRays& rays, int width, int height,
                               std::span<std::uint32_t> ids) = 0;

  // Pass 2: sets (s, t) of each pixel to the perspective-correct barycentric coordinates for vertices 1 and 2
  // of the triangle that pass 1 found, with s, t >= 0 and s + t <= 1 up to rounding. Pass 2 does not change
  // the entries of s and t for pixels without a triangle. REQUIRES: `ids` is the result of the last
  // DrawTriangleIds(); `ids`, `s` and `t` have equal sizes.
  virtual void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s,
                                std::span<float> t) = 0;

 protected:
  Passes() = default;
  Passes(const Passes&) = default;
  Passes& operator=(const Passes&) = default;
};

}  // namespace penumbra
