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
#include "display/passes.h"
#include "display/vector_kernels.h"
#include "solver/geometry/vec.h"

namespace penumbra {

// Draws one set of triangles from any eye. Back faces are culled (thesis 3.6, footnote 1): a triangle is seen
// only where its vertices run counter-clockwise. Memory is kept from picture to picture.
class Rasteriser : public Passes {
 public:
  // REQUIRES: indices lie in `positions`, fewer than kNoTriangle triangles, finite positions.
  Rasteriser(std::span<const Vec3> positions, std::vector<VertexIndices> triangles);
  ~Rasteriser() override;
  Rasteriser(Rasteriser&&) noexcept;
  Rasteriser& operator=(Rasteriser&&) noexcept;

  //  (1) Triangles that share an edge or lie on two sides of one leave no pixel between them.
  //  (2) At equal depth to rounding one of the two wins, at exactly equal depth the lower index.
  //  (3) The same ids for every number of threads.
  void DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) override;
  // Within kBarycentricError of the ray's intersection with the triangle, for triangles of more than a pixel.
  void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) override;

  std::size_t TriangleCount() const;

  // The same two passes tile by tile, so that a picture need not leave the processor's caches between them
  // and what follows. Prepare() sorts the triangles into the tiles of TileGrid(width, height); the others may
  // then be called from several threads, for a tile of their own each.
  void Prepare(const PixelRays& rays, int width, int height);
  void DrawTileIds(std::size_t index, Tile* tile) const;  // clears the tile, too
  void DrawRowBarycentrics(BlockRow* row) const;          // REQUIRES: FindRuns

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr double kBarycentricError = 1e-5;

}  // namespace penumbra
