// display/rasteriser.h
//
// The two scratch images of the two-pass display (thesis 3.4.1 and 3.4.2): which triangle is visible at the
// centre of every pixel, and the barycentric coordinates there.
//
// A triangle is drawn by the homogeneous edge functions of Olano and Greer (1997): the plane through the eye
// and an edge is an affine function of the picture coordinates wherever the vertices lie, so nothing is
// clipped, and a triangle that reaches behind the eye is drawn exactly where rays from the eye meet it. Each
// value is set up in binary64 and carried to a tile of 64 x 64 pixels, where it is a float measured from the
// tile's corner.
//
// Departures from the thesis: coordinates come from the triangle's edge functions and not from a texture of
// 256^2 texels, so they carry floats' precision; all T-vertices are closed, those of its case C (3.6) too, by
// drawing every triangle kFringe of a pixel too large, the surplus a little deeper.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "display/camera.h"
#include "solver/geometry/vec.h"

namespace penumbra {

inline constexpr std::uint32_t kNoTriangle = 0xffffffffu;

// Draws one set of triangles from any eye. Back faces are culled (thesis 3.6, footnote 1): a triangle is seen
// only where its vertices run counter-clockwise. Memory is kept from picture to picture.
class Rasteriser {
 public:
  using VertexIndices = std::array<std::uint32_t, 3>;

  // REQUIRES: indices lie in `positions`, fewer than kNoTriangle triangles, finite positions.
  Rasteriser(std::vector<Vec3> positions, std::vector<VertexIndices> triangles);
  ~Rasteriser();
  Rasteriser(Rasteriser&&) noexcept;
  Rasteriser& operator=(Rasteriser&&) noexcept;

  // Pass 1: ids[y * width + x] is the index of the visible triangle, or kNoTriangle.
  //  (1) Triangles that share an edge or lie on two sides of one leave no pixel between them.
  //  (2) At equal depth to rounding one of the two wins, at exactly equal depth the lower index.
  //  (3) The same ids for every number of threads.
  // REQUIRES: ids.size() == width * height; 0 < width, height <= kMaxPictureSize.
  void DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids);

  // Pass 2: (s, t), the perspective-correct coordinates of vertices 1 and 2 of the triangles that pass 1
  // found, with s, t >= 0 and s + t <= 1 to rounding; within kBarycentricError of the ray's intersection with
  // the triangle for triangles of more than a pixel. Unchanged where there is no triangle. REQUIRES: ids are
  // those of the last DrawTriangleIds; spans of the same size.
  void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) const;

  std::size_t TriangleCount() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr int kMaxPictureSize = 32768;
inline constexpr double kBarycentricError = 1e-5;

// Calls body(x, n) for the runs of equal ids in row y, cut at kTileSize pixels: pixels x .. x + n - 1.
template <class Body>
void ForEachRun(std::span<const std::uint32_t> row, int max_run, const Body& body) {
  const int width = static_cast<int>(row.size());
  for (int x = 0; x < width;) {
    const std::uint32_t id = row[static_cast<std::size_t>(x)];
    const int limit = width - x < max_run ? width : x + max_run;
    int end = x + 1;
    while (end < limit && row[static_cast<std::size_t>(end)] == id) ++end;
    body(x, end - x, id);
    x = end;
  }
}

}  // namespace penumbra
