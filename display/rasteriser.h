// display/rasteriser.h
//
// Draws the two scratch images of the two-pass display in software (thesis 3.4.1 and 3.4.2): the triangle
// that is visible at the centre of every pixel, and the barycentric coordinates there.
//
// A triangle is drawn by the homogeneous edge functions of Olano and Greer (1997): the plane through the eye
// and an edge is an affine function of the picture coordinates for any position of the vertices. Therefore
// nothing is clipped, and a triangle that extends behind the eye covers exactly the pixels whose rays meet
// it. Each function is set up in binary64 and translated to tiles of 64 x 64 pixels, where it is evaluated in
// floats relative to the tile's corner.
//
// Departures from the thesis: coordinates come from the triangle's edge functions and not from a texture of
// 256^2 texels, so they have the precision of floats. Gaps at all T-vertices are closed, including case C
// (3.6): every triangle is drawn kFringe of a pixel too large, and the surplus is drawn slightly deeper.

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

// Draws one set of triangles for any camera. Back faces are culled (thesis 3.6, footnote 1): a triangle is
// visible only if its vertices are counter-clockwise in the picture. Memory is reused from picture to
// picture.
class Rasteriser : public Passes {
 public:
  // REQUIRES: valid indices in `positions`, fewer than kNoTriangle triangles, finite positions.
  Rasteriser(std::span<const Vec3> positions, std::vector<VertexIndices> triangles);
  ~Rasteriser() override;
  Rasteriser(Rasteriser&&) noexcept;
  Rasteriser& operator=(Rasteriser&&) noexcept;

  //  (1) Triangles that share an edge or lie on two sides of one leave no pixel between them.
  //  (2) Of two triangles whose depths differ by rounding only, one wins; at equal depths the lower index.
  //  (3) The ids do not depend on the number of threads.
  void DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) override;
  // For triangles larger than a pixel, the coordinates of the ray's intersection with the triangle to
  // kBarycentricError.
  void DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s, std::span<float> t) override;

  std::size_t TriangleCount() const;

  // The same two passes tile by tile, so that intermediate values stay in the processor's caches. Prepare()
  // sorts the triangles into the tiles of TileGrid(width, height). Then several threads may call the other
  // two functions, each thread for its own tile.
  void Prepare(const PixelRays& rays, int width, int height);
  void DrawTileIds(std::size_t index, Tile* tile) const;  // clears the tile first
  void DrawRowBarycentrics(BlockRow* row) const;          // REQUIRES: FindRuns(row)

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

inline constexpr double kBarycentricError = 1e-5;

}  // namespace penumbra
