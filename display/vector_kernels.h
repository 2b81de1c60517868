// display/vector_kernels.h
//
// The inner loops of the display over a tile of the picture, compiled for several instruction sets of which
// the machine's best is chosen at run time. Element by element they do the same IEEE operations whatever the
// vector width, so all of them give the same bytes.
//
// A tile's values lie block by block, 4 x 4 pixels together: a block is one vector, and most blocks show a
// single triangle.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "display/image.h"

namespace penumbra {

inline constexpr int kTileSize = 64;  // pixels a side
inline constexpr int kTilePixels = kTileSize * kTileSize;
inline constexpr int kBlockSize = 4;  // pixels a side
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
inline constexpr int kBlocksAcross = kTileSize / kBlockSize;
inline constexpr int kRowPixels = kBlocksAcross * kBlockPixels;  // of a row of blocks

// Where the four pixels of a tile, or of a row of its blocks, that begin at column x, a multiple of 4, and
// row y lie in its arrays.
inline constexpr int TileIndex(int x, int y) {
  return (y / kBlockSize * kBlocksAcross + x / kBlockSize) * kBlockPixels + y % kBlockSize * kBlockSize;
}

// An affine function of the picture coordinates, in binary64.
struct Plane {
  double x = 0, y = 0, c = 0;

  double At(double px, double py) const { return c + x * px + y * py; }
  Plane Scaled(double k) const { return {x * k, y * k, c * k}; }
};

// A triangle as one tile of the screen sees it. Values are affine in the column i and the row j of a pixel in
// its tile: value = c + i x + j y.
struct TileTriangle {
  struct Affine {
    float x, y, c;
  };
  Affine edge[3];    // signed distances to the edges [pixels], positive inside
  Affine inverse_z;  // 1 / depth [1/m]
  float max_inverse_z;
  std::uint32_t id;
  int column_begin, column_end, row_begin, row_end;  // its bounds in the tile
};

// Where a pixel centre lies outside a triangle, yet by less than this [pixels], the triangle is drawn all the
// same, a little deeper. This closes what rounding opens: T-vertices between patches, and vertices that lie
// exactly in a pixel's centre. It is far above the rounding of the edge functions in a tile (below 2^-16) and
// far below what can be seen.
inline constexpr float kFringe = 0x1p-10f;

// What the display knows about a triangle's light, each value for red, green and blue.
struct TriangleShade {
  float a[3], b2[3], c2[3], d[3], e2[3], f[3];  // the irradiance interpolant, QuadraticInterpolant [W/m^2]
  float reflectance[3];
  float emittance[3];  // [W/m^2]
};

// A tile whose triangles are being found.
struct Tile {
  int x = 0, y = 0;  // its upper left pixel in the picture
  alignas(64) std::uint32_t ids[kTilePixels];
  alignas(64) float inverse_z[kTilePixels];  // 1 / depth, 0 where there is nothing
};

// The pixels of a block that show one triangle.
struct BlockRun {
  std::uint32_t id;
  std::uint16_t block;
};

// A row of a tile's blocks on its way from the triangles to the screen: what a processor's first cache holds.
struct BlockRow {
  int x = 0, y = 0;  // its upper left pixel in the picture
  alignas(64) std::uint32_t ids[kRowPixels];
  alignas(64) float s[kRowPixels], t[kRowPixels];
  alignas(64) float rgb[3][kRowPixels];
  alignas(64) std::uint32_t screen[kRowPixels];  // a pixel's codes: red + 2^8 green + 2^16 blue
  int run_count = 0;
  BlockRun runs[kRowPixels];
};

// Nothing in the whole tile yet.
void ClearTile(Tile* tile);

// Draws the triangle into `inverse_z` and `ids`. A nearer triangle wins; of equally near ones the lower id:
// the order does not matter.
void DrawTileTriangle(const TileTriangle& triangle, Tile* tile);

// Parts of a tile that know how far the farthest of their pixels is: what lies behind it all is not drawn.
inline constexpr int kRegionSize = 16;  // pixels a side
inline constexpr int kRegionsAcross = kTileSize / kRegionSize;
using RegionDepths = std::array<float, kRegionsAcross * kRegionsAcross>;

// The least `inverse_z` of each region.
void FindFarthest(const Tile& tile, RegionDepths* farthest);

// Collects `runs` from `ids`.
void FindRuns(BlockRow* row);

// (s, t), the coordinates of vertices 1 and 2, inside the triangle in spite of rounding, where there is one.
// planes[3 id + k] is proportional to the coordinate of vertex k. REQUIRES: FindRuns; the planes' values are
// floats anywhere in the picture.
void FillBarycentrics(const Plane* planes, BlockRow* row);

// rgb = max(irradiance(s, t), 0) x reflectance + emittance [W/m^2], and `background` where there is no
// triangle. Irradiance is clamped since a quadratic through nonnegative samples may dip below 0 between them.
// REQUIRES: FindRuns; s and t.
void EvaluateRadiosity(const TriangleShade* shades, float background, BlockRow* row);

// The transfer of a linear value in [0, 1] to 8 bits. Dithered: 255 times the encoded value, an offset in
// (0, 1) added, is within 1e-3 of the exact one before it is rounded down. Else: the nearest code, exactly.
struct ScreenTransfer {
  // `dither`: 64 offsets, rows of 8; null: round to the nearest code.
  ScreenTransfer(float exposure, float background, const float* dither);

  float exposure;    // factor of the values, which are cut off at 1 afterwards
  float background;  // what shows, linear, where a value is negative
  bool dithered;
  // Of the pixels of two blocks side by side, in even rows of blocks and in odd ones: there the dither
  // repeats.
  alignas(64) float offset[2][2 * kBlockPixels] = {};
};

// `screen` from `rgb`.
void FillScreen(const ScreenTransfer& transfer, BlockRow* row);

// min(max(exposure x value, 0), 1) of n values; emitters become 1, background `background`.
void ExposeRow(const float* value, const PixelKind* kind, float exposure, float background, std::size_t n,
               float* exposed);

// The codes of n exposed pixels of a row, as in Tile::screen. `dither`: 8 offsets in (0, 1), or null.
void EncodeRow(const float* red, const float* green, const float* blue, std::size_t n, const float* dither,
               std::uint32_t* codes);

// Three bytes a pixel from n codes.
void PackRow(const std::uint32_t* codes, std::size_t n, std::uint8_t* bytes);

// The same of the first n of row y of `screen`.
void PackScreen(const BlockRow& row, int y, std::size_t n, std::uint8_t* bytes);

}  // namespace penumbra
