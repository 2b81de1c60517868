// display/vector_kernels.h
//
// The inner loops of the display over a tile of the picture, compiled for several instruction sets. The
// program selects the best set at run time. All vector widths perform the same IEEE operations on each
// element and give the same bytes.
//
// The values of a tile are stored in blocks of 4 x 4 pixels. A block fits one vector, and most blocks show a
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

// The index, in the arrays of a tile or of a row of its blocks, of the four pixels that begin at column x, a
// multiple of 4, in row y.
inline constexpr int TileIndex(int x, int y) {
  return (y / kBlockSize * kBlocksAcross + x / kBlockSize) * kBlockPixels + y % kBlockSize * kBlockSize;
}

// An affine function of the picture coordinates, in binary64.
struct Plane {
  double x = 0, y = 0, c = 0;

  double At(double px, double py) const { return c + x * px + y * py; }
  Plane Scaled(double k) const { return {x * k, y * k, c * k}; }
};

// A triangle in the coordinates of one tile. An affine function has the value c + i x + j y at the pixel in
// column i and row j of the tile.
struct TileTriangle {
  struct Affine {
    float x, y, c;
  };
  Affine edge[3];    // signed distances to the edges [pixels], positive inside
  Affine inverse_z;  // 1 / depth [1/m]
  float max_inverse_z;
  std::uint32_t id;
  int column_begin, column_end, row_begin, row_end;  // bounds in the tile
};

// A triangle also covers pixels whose centres lie outside of it by less than this distance [pixels]; these
// are drawn slightly deeper. The fringe closes gaps that rounding causes, at T-vertices between patches and
// at vertices that lie exactly in the centre of a pixel. The width of the fringe is far larger than the
// rounding of the edge functions in a tile (below 2^-16), and far too small to be visible.
inline constexpr float kFringe = 0x1p-10f;

// The light of a triangle, for red, green and blue.
struct TriangleShade {
  float a[3], b2[3], c2[3], d[3], e2[3], f[3];  // coefficients of the QuadraticInterpolant [W/m^2]
  float reflectance[3];
  float emittance[3];  // [W/m^2]
};

// A tile during pass one.
struct Tile {
  int x = 0, y = 0;  // its upper left pixel in the picture
  alignas(64) std::uint32_t ids[kTilePixels];
  alignas(64) float inverse_z[kTilePixels];  // 1 / depth; 0 without a triangle
};

// A triangle that is visible in a block of 4 x 4 pixels.
struct BlockRun {
  std::uint32_t id;
  std::uint16_t block;
};

// A row of a tile's blocks during pass two and tone mapping, of a size that fits the first-level cache.
struct BlockRow {
  int x = 0, y = 0;  // its upper left pixel in the picture
  alignas(64) std::uint32_t ids[kRowPixels];
  alignas(64) float s[kRowPixels], t[kRowPixels];
  alignas(64) float rgb[3][kRowPixels];
  alignas(64) std::uint32_t screen[kRowPixels];  // codes: red + 2^8 green + 2^16 blue
  int run_count = 0;
  BlockRun runs[kRowPixels];
};

// Marks all pixels of the tile as empty.
void ClearTile(Tile* tile);

// Draws the triangle into `inverse_z` and `ids`. The nearest triangle wins, and of equally near ones the one
// with the lowest id, so that the order of drawing does not matter.
void DrawTileTriangle(const TileTriangle& triangle, Tile* tile);

// Regions of a tile that store the depth of their farthest pixel. Triangles that lie behind the farthest
// pixels of all regions that they could cover are not drawn.
inline constexpr int kRegionSize = 16;  // pixels a side
inline constexpr int kRegionsAcross = kTileSize / kRegionSize;
using RegionDepths = std::array<float, kRegionsAcross * kRegionsAcross>;

// Sets `farthest` to the smallest `inverse_z` of each region.
void FindFarthest(const Tile& tile, RegionDepths* farthest);

// Computes `runs` from `ids`.
void FindRuns(BlockRow* row);

// Computes (s, t), the barycentric coordinates for vertices 1 and 2, clamped to the triangle, for pixels with
// a triangle. planes[3 id + k] is proportional to the coordinate of vertex k. REQUIRES: FindRuns() was
// called; the values of the planes are in the range of floats everywhere in the picture.
void FillBarycentrics(const Plane* planes, BlockRow* row);

// Computes rgb = max(irradiance(s, t), 0) * reflectance + emittance [W/m^2], and `background` for pixels
// without a triangle. Irradiance is clamped because a quadratic through nonnegative samples may be negative
// between them. REQUIRES: FindRuns() was called, and s and t are set.
void EvaluateRadiosity(const TriangleShade* shades, float background, BlockRow* row);

// The transfer of a linear value in [0, 1] to 8 bits. With dither: 255 * (encoded value) + offset, with an
// offset in (0, 1), is computed to 1e-3 and rounded down. Without dither: the nearest code, exactly.
struct ScreenTransfer {
  // `dither`: 64 offsets in rows of 8, or null for the nearest code.
  ScreenTransfer(float exposure, float background, const float* dither);

  float exposure;    // factor of the values, which are then clipped at 1
  float background;  // linear value shown for negative values
  bool dithered;
  // The offsets of two neighbouring blocks, in even and in odd rows of blocks: the dither repeats every 8 x 8
  // pixels.
  alignas(64) float offset[2][2 * kBlockPixels] = {};
};

// Computes `screen` from `rgb`.
void FillScreen(const ScreenTransfer& transfer, BlockRow* row);

// Computes min(max(exposure * value, 0), 1) for n values. Emitters become 1, background pixels `background`.
void ExposeRow(const float* value, const PixelKind* kind, float exposure, float background, std::size_t n,
               float* exposed);

// Computes the codes of n exposed pixels of a row, in the format of BlockRow::screen. `dither`: 8 offsets in
// (0, 1), or null for the nearest codes.
void EncodeRow(const float* red, const float* green, const float* blue, std::size_t n, const float* dither,
               std::uint32_t* codes);

// Converts n codes to three bytes per pixel.
void PackRow(const std::uint32_t* codes, std::size_t n, std::uint8_t* bytes);

// Converts the first n codes in pixel row y of row.screen to three bytes per pixel.
void PackScreen(const BlockRow& row, int y, std::size_t n, std::uint8_t* bytes);

}  // namespace penumbra
