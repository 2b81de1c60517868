// display/vector_kernels.h
//
// The inner loops of the two-pass display, which process a tile (64 x 64 pixels) of the picture. The inner
// loops are compiled for several instruction sets, of which the program selects the best one at run time. All
// instruction sets perform the same IEEE operations on each pixel and give the same bytes.
//
// The values of a tile are stored in blocks of 4 x 4 pixels. The 16 values of a block fit one vector
// register, and most blocks show a single triangle.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "display/image.h"

namespace penumbra {

inline constexpr int kTileSize = 64;  // the side of a square tile of the picture [pixels]
inline constexpr int kTilePixels = kTileSize * kTileSize;
inline constexpr int kBlockSize = 4;  // the side of a square block of pixels in a tile [pixels]
inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
inline constexpr int kBlocksAcross = kTileSize / kBlockSize;
inline constexpr int kRowPixels = kBlocksAcross * kBlockPixels;  // number of pixels in a row of blocks

// The index of pixel (x, y) in the arrays of a tile, or of a row of blocks, where x is a multiple of 4. The
// three indices after that of pixel (x, y) belong to the pixels (x + 1, y), (x + 2, y) and (x + 3, y).
inline constexpr int TileIndex(int x, int y) {
  return (y / kBlockSize * kBlocksAcross + x / kBlockSize) * kBlockPixels + y % kBlockSize * kBlockSize;
}

// An affine function of the picture coordinates, in binary64.
struct Plane {
  double x = 0, y = 0, c = 0;

  double At(double px, double py) const { return c + x * px + y * py; }
  Plane Scaled(double k) const { return {x * k, y * k, c * k}; }
};

// A triangle in the coordinates of one tile. The value of an Affine at the pixel in column i and row j of the
// tile is c + i x + j y.
struct TileTriangle {
  struct Affine {
    float x, y, c;
  };
  Affine edge[3];    // signed distances to the triangle's edges [pixels], positive inside
  Affine inverse_z;  // 1 / (depth of the triangle), as a function of picture coordinates [1/m]
  float max_inverse_z;
  std::uint32_t id;
  int column_begin, column_end, row_begin, row_end;  // bounding box of the triangle in the tile
};

// The width of a triangle's fringe [pixels]: a triangle also covers pixels whose centres lie outside the
// triangle by less than kFringe, slightly deeper than the triangle. The fringe around a triangle closes gaps
// that rounding causes, at T-vertices between patches and at vertices that lie exactly in the centre of a
// pixel. The fringe kFringe is far larger than the rounding of the edge functions in a tile (below 2^-16
// pixels), and far too small to be visible.
inline constexpr float kFringe = 0x1p-10f;

// The data from which the radiosity of a triangle is computed, for red, green and blue.
struct TriangleShade {
  float a[3], b2[3], c2[3], d[3], e2[3], f[3];  // coefficients of the QuadraticInterpolant [W/m^2]
  float reflectance[3];
  float emittance[3];  // emittance of the patch [W/m^2]
};

// The data of a tile (64 x 64 pixels) in pass one, which finds triangle ids.
struct Tile {
  int x = 0, y = 0;  // the picture coordinates of the upper left pixel
  alignas(64) std::uint32_t ids[kTilePixels];
  alignas(64) float inverse_z[kTilePixels];  // 1 / depth of each pixel [1/m]; 0 at pixels without a triangle
};

// A triangle that is visible in a block of 4 x 4 pixels.
struct BlockRun {
  std::uint32_t id;
  std::uint16_t block;
};

// The data of one row of 4 x 4 blocks of a tile, in pass two (barycentric coordinates) and in tone mapping. A
// BlockRow fits into the processor's first-level cache.
struct BlockRow {
  int x = 0, y = 0;  // the picture coordinates of the upper left pixel
  alignas(64) std::uint32_t ids[kRowPixels];
  alignas(64) float s[kRowPixels], t[kRowPixels];
  alignas(64) float rgb[3][kRowPixels];
  alignas(64) std::uint32_t screen[kRowPixels];  // code of each pixel: red + 2^8 green + 2^16 blue
  int run_count = 0;
  BlockRun runs[kRowPixels];
};

// Marks all pixels of the tile as empty.
void ClearTile(Tile* tile);

// Draws the triangle into tile->inverse_z and tile->ids. Each pixel of the tile shows the nearest triangle;
// if several triangles are nearest, the pixel shows the triangle with the lowest id. The drawn tile therefore
// does not depend on the order in which triangles are drawn.
void DrawTileTriangle(const TileTriangle& triangle, Tile* tile);

// A tile is divided into regions of 16 x 16 pixels; for each region, the depth of the farthest pixel is
// stored. A triangle is skipped if it lies behind the farthest pixel of every region that the triangle could
// cover.
// The side of a square region of a tile, for which the farthest depth is known [pixels].
inline constexpr int kRegionSize = 16;
inline constexpr int kRegionsAcross = kTileSize / kRegionSize;
using RegionDepths = std::array<float, kRegionsAcross * kRegionsAcross>;

// Sets `farthest` to the smallest `inverse_z` of each region.
void FindFarthest(const Tile& tile, RegionDepths* farthest);

// Computes row->runs, the list of triangles that are visible in each 4 x 4 block, from row->ids.
void FindRuns(BlockRow* row);

// For each pixel with a triangle, computes the barycentric coordinates (s, t) for vertices 1 and 2, and
// clamps (s, t) to the triangle. The entry planes[3 id + k] is a function proportional to the barycentric
// coordinate for vertex k of triangle `id`. REQUIRES: FindRuns() was called; the values of the planes are in
// the range of floats everywhere in the picture.
void FillBarycentrics(const Plane* planes, BlockRow* row);

// Sets row->rgb to max(irradiance(s, t), 0) * reflectance + emittance [W/m^2], or to `background` for pixels
// without a triangle. Irradiance is clamped because a quadratic through nonnegative samples may be negative
// between the samples. REQUIRES: FindRuns() was called, and s and t are set.
void EvaluateRadiosity(const TriangleShade* shades, float background, BlockRow* row);

// Converts linear values in [0, 1] to 8-bit codes. With dither, the 8-bit code is floor(255 * (encoded value)
// + offset), with an offset in (0, 1) and an error of up to 1e-3 before rounding. Without dither, the code is
// exactly the nearest 8-bit code.
struct ScreenTransfer {
  // `dither` points to 64 offsets in rows of 8; if `dither` is null, values are converted to the nearest
  // code.
  ScreenTransfer(float exposure, float background, const float* dither);

  float exposure;    // factor by which values are multiplied before they are clipped at 1
  float background;  // linear value shown at background pixels, which have negative values
  bool dithered;
  // The dither offsets of two neighbouring blocks: offset[0] in even rows of blocks, offset[1] in odd rows.
  // The dither pattern repeats every 8 x 8 pixels.
  alignas(64) float offset[2][2 * kBlockPixels] = {};
};

// Computes row->screen (8-bit codes) from row->rgb (linear values).
void FillScreen(const ScreenTransfer& transfer, BlockRow* row);

// Sets exposed[i] = min(max(exposure * value[i], 0), 1) for n pixels of surfaces. ExposeRow() sets exposed[i]
// to 1 for emitters, and to `background` for background pixels.
void ExposeRow(const float* value, const PixelKind* kind, float exposure, float background, std::size_t n,
               float* exposed);

// Computes the codes of n exposed pixels of a row, in the format of BlockRow::screen. `dither` points to 8
// offsets in (0, 1); if `dither` is null, values are converted to the nearest codes.
void EncodeRow(const float* red, const float* green, const float* blue, std::size_t n, const float* dither,
               std::uint32_t* codes);

// Converts n pixel codes to three bytes (red, green, blue) per pixel.
void PackRow(const std::uint32_t* codes, std::size_t n, std::uint8_t* bytes);

// Converts the first n pixel codes in pixel row y of row.screen to three bytes (red, green, blue) per pixel.
void PackScreen(const BlockRow& row, int y, std::size_t n, std::uint8_t* bytes);

}  // namespace penumbra
