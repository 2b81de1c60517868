// display/vector_kernels.h
//
// The inner loops of the display: plain loops over floats that the compiler turns into vector code, compiled
// for several instruction sets of which the machine's best is chosen at run time. Element by element they do
// the same IEEE operations whatever the vector width, so all of them give the same bytes.

#pragma once

#include <cstddef>
#include <cstdint>

#include "display/image.h"

namespace penumbra {

inline constexpr int kTileSize = 64;  // pixels; also the longest run of the loops below

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
  bool covers_tile;                                  // the whole tile lies inside all edges
};

// Where a pixel centre lies outside a triangle, yet by less than this [pixels], the triangle is drawn all the
// same, a little deeper. This closes what rounding opens: T-vertices between patches, and vertices that lie
// exactly in a pixel's centre. It is far above the rounding of the edge functions in a tile (below 2^-16) and
// far below what can be seen.
inline constexpr float kFringe = 0x1p-10f;

// Draws the triangle into a tile of kTileSize^2 values of 1 / depth, where 0 is infinitely far, and of ids. A
// nearer triangle wins; of equally near ones the one drawn first.
void DrawTileTriangle(const TileTriangle& triangle, float* inverse_z, std::uint32_t* ids);

// Three values that are affine along a row, proportional to the barycentric coordinates of vertices 0, 1
// and 2.
struct BarycentricRun {
  float start[3], step[3];
};

// The coordinates (s, t) of vertices 1 and 2 at n <= kTileSize pixels of a row, inside the triangle in spite
// of rounding.
void FillBarycentrics(const BarycentricRun& run, int n, float* s, float* t);

// What the display knows about a triangle's light, each value for red, green and blue.
struct TriangleShade {
  float a[3], b2[3], c2[3], d[3], e2[3], f[3];  // the irradiance interpolant, QuadraticInterpolant [W/m^2]
  float reflectance[3];
  float emittance[3];  // [W/m^2]
};

// Radiosity = max(irradiance(s, t), 0) x reflectance + emittance of one channel at n <= kTileSize pixels
// [W/m^2]. Irradiance is clamped since a quadratic through nonnegative samples may dip below 0 between them.
void EvaluateRadiosity(const TriangleShade& shade, int channel, const float* s, const float* t, int n,
                       float* radiosity);

// min(max(exposure x value, 0), 1) of n values; emitters become 1, background `background`.
void ExposeRow(const float* value, const PixelKind* kind, float exposure, float background, std::size_t n,
               float* exposed);

// The sRGB code of n values in [0, 1], scaled to 255, `dither[i % 8]` added, rounded; within 2e-4 of a code
// of the exact transfer before rounding.
void EncodeSrgbRow(const float* linear, const float* dither, std::size_t n, std::uint8_t* code);

}  // namespace penumbra
