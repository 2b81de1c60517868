// display/rasteriser.h
//
// The software rasteriser of the two-pass display (thesis 3.4.1 and 3.4.2) finds, for each pixel, the
// triangle that is visible at the pixel's centre, and the barycentric coordinates of the visible point.
//
// A triangle is drawn by the homogeneous edge functions of Olano and Greer (1997). The plane through the eye
// and an edge of the triangle corresponds to an affine function of the picture coordinates, even if vertices
// lie behind the eye. With homogeneous edge functions, triangles need not be clipped, and a triangle that
// extends behind the eye covers exactly the pixels whose rays intersect it. Each edge function is computed in
// binary64. The picture is divided into tiles of 64 x 64 pixels, in which edge functions are evaluated in
// floats relative to the tile's corner.
//
// The rasteriser differs from the thesis in two ways. Barycentric coordinates are computed from the
// triangle's edge functions, with the precision of floats, instead of from a texture of 256^2 texels. Gaps at
// all T-vertices are closed, including case C of the thesis (3.6): every triangle is enlarged by kFringe
// pixels, and the additional pixels are drawn slightly deeper.

#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "display/camera.h"
#include "display/passes.h"
#include "display/vector_kernels.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Draws a fixed set of triangles for any camera. Back faces are culled (thesis 3.6, footnote 1): a triangle
// is visible only if its vertices are counter-clockwise in the picture. The rasteriser reuses its memory from
// picture to picture.
class Rasteriser : public Passes {
 public:
  // REQUIRES: all indices are valid in `positions`; there are fewer than kNoTriangle triangles; all positions
  // are finite.
  Rasteriser(std::span<const Vec3> positions, std::vector<VertexIndices> triangles);
  ~Rasteriser() override;
  Rasteriser(Rasteriser&&) noexcept;
  Rasteriser& operator=(Rasteriser&&) noexcept;

  // Between two triangles that share an edge, or a part of an edge, no pixel is left empty. If the depths of
  // two triangles at a pixel differ only by rounding, either triangle may be drawn. If the depths of two
  // triangles at a pixel are equal, the triangle with the lower index is drawn. The triangle ids do not
  // depend on the number of threads.
  void DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) override;
  // For triangles larger than a pixel, the error of the barycentric coordinates of the intersection of ray
  // and triangle is at most kBarycentricError.
  void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) override;

  std::size_t TriangleCount() const;

  // Prepare(), DrawTileIds() and DrawRowBarycentrics() draw the two passes tile by tile, so that intermediate
  // values stay in the processor's caches. First, Prepare() sorts the triangles into the tiles of
  // TileGrid(width, height). After Prepare(), several threads may call DrawTileIds() and
  // DrawRowBarycentrics(), each thread for its own tile.
  void Prepare(const PixelRays& rays, int width, int height);
  void DrawTileIds(std::size_t index, Tile* tile) const;  // DrawTileIds() clears the tile first
  void DrawRowBarycentrics(BlockRow* row) const;          // REQUIRES: FindRuns(row) was called

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr double kBarycentricError = 1e-5;

}  // namespace penumbra
