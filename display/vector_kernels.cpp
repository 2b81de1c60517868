#include "display/vector_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "solver/base/vector_dispatch.h"

namespace penumbra {
namespace {

// Pixels that are drawn together: a tile's rows are a multiple of it, so that blocks need no remainder.
constexpr int kBlock = 8;
static_assert(kTileSize % kBlock == 0);

constexpr std::array<float, kTileSize> kColumn = [] {
  std::array<float, kTileSize> column{};
  for (int i = 0; i < kTileSize; ++i) column[static_cast<std::size_t>(i)] = static_cast<float>(i);
  return column;
}();

constexpr std::size_t kDitherSpan = 128;  // pixels encoded at a time; a multiple of the dither's period

inline float Min(float a, float b) { return a < b ? a : b; }
inline float Max(float a, float b) { return a > b ? a : b; }

}  // namespace

PENUMBRA_VECTOR_CLONES
void DrawTileTriangle(const TileTriangle& triangle, float* __restrict inverse_z,
                      std::uint32_t* __restrict ids) {
  const int begin = triangle.column_begin / kBlock * kBlock;
  const float first = static_cast<float>(triangle.column_begin),
              last = static_cast<float>(triangle.column_end - 1);
  const float e0x = triangle.edge[0].x, e1x = triangle.edge[1].x, e2x = triangle.edge[2].x;
  const float wx = triangle.inverse_z.x, w_max = triangle.max_inverse_z;
  const std::uint32_t id = triangle.id;
  for (int row = triangle.row_begin; row < triangle.row_end; ++row) {
    const float y = static_cast<float>(row);
    const float e0 = triangle.edge[0].c + triangle.edge[0].y * y;
    const float e1 = triangle.edge[1].c + triangle.edge[1].y * y;
    const float e2 = triangle.edge[2].c + triangle.edge[2].y * y;
    const float w0 = triangle.inverse_z.c + triangle.inverse_z.y * y;
    float* __restrict z_row = inverse_z + row * kTileSize;
    std::uint32_t* __restrict id_row = ids + row * kTileSize;
    if (triangle.covers_tile) {
      for (int i = 0; i < kTileSize; ++i) {
        const float w = Min(w0 + wx * kColumn[i], w_max);
        const bool nearer = w > z_row[i];
        z_row[i] = nearer ? w : z_row[i];
        id_row[i] = nearer ? id : id_row[i];
      }
      continue;
    }
    for (int block = begin; block < triangle.column_end; block += kBlock) {
      for (int i = block; i < block + kBlock; ++i) {
        const float x = kColumn[i];
        const float inside = Min(e0 + e0x * x, Min(e1 + e1x * x, e2 + e2x * x));
        const float w = Min(w0 + wx * x, w_max);
        const float w_drawn = w + w * Min(inside, 0.0f);
        const bool drawn = (inside >= -kFringe) & (x >= first) & (x <= last) & (w_drawn > z_row[i]);
        z_row[i] = drawn ? w_drawn : z_row[i];
        id_row[i] = drawn ? id : id_row[i];
      }
    }
  }
}

PENUMBRA_VECTOR_CLONES
void FillBarycentrics(const BarycentricRun& run, int n, float* __restrict s, float* __restrict t) {
  const float a0 = run.start[0], a1 = run.start[1], a2 = run.start[2];
  const float d0 = run.step[0], d1 = run.step[1], d2 = run.step[2];
  for (int i = 0; i < n; ++i) {
    const float x = kColumn[i];
    const float b0 = Max(a0 + d0 * x, 0.0f), b1 = Max(a1 + d1 * x, 0.0f), b2 = Max(a2 + d2 * x, 0.0f);
    const float scale = 1.0f / Max(b0 + b1 + b2, std::numeric_limits<float>::min());
    s[i] = b1 * scale;
    t[i] = b2 * scale;
  }
}

PENUMBRA_VECTOR_CLONES
void EvaluateRadiosity(const TriangleShade& shade, int channel, const float* __restrict s,
                       const float* __restrict t, int n, float* __restrict radiosity) {
  const float a = shade.a[channel], b2 = shade.b2[channel], c2 = shade.c2[channel];
  const float d = shade.d[channel], e2 = shade.e2[channel], f = shade.f[channel];
  const float reflectance = shade.reflectance[channel], emittance = shade.emittance[channel];
  for (int i = 0; i < n; ++i) {
    const float irradiance = (a * s[i] + b2 * t[i] + c2) * s[i] + (d * t[i] + e2) * t[i] + f;
    radiosity[i] = Max(irradiance, 0.0f) * reflectance + emittance;
  }
}

PENUMBRA_VECTOR_CLONES
void ExposeRow(const float* __restrict value, const PixelKind* __restrict kind, float exposure,
               float background, std::size_t n, float* __restrict exposed) {
  for (std::size_t i = 0; i < n; ++i) {
    const float surface = Min(Max(value[i] * exposure, 0.0f), 1.0f);
    const float lit = kind[i] == PixelKind::kEmitter ? 1.0f : surface;
    exposed[i] = kind[i] == PixelKind::kBackground ? background : lit;
  }
}

PENUMBRA_VECTOR_CLONES
void EncodeSrgbRow(const float* __restrict linear, const float* __restrict dither, std::size_t n,
                   std::uint8_t* __restrict code) {
  // The offsets laid out once, so that the loop below reads all its arrays straight on.
  std::array<float, kDitherSpan> offset;
  for (std::size_t i = 0; i < kDitherSpan; ++i) offset[i] = 0.5f + dither[i % 8];
  for (std::size_t begin = 0; begin < n; begin += kDitherSpan) {
    const std::size_t count = n - begin < kDitherSpan ? n - begin : kDitherSpan;
    for (std::size_t i = 0; i < count; ++i) {
      const float x = linear[begin + i];
      // x^(5/12) = x y^7 with y = x^(-1/12) by Newton's iteration from a logarithm read off the exponent
      // bits.
      const float z = Max(x, 0x1p-10f);
      const float log2z = static_cast<float>(std::bit_cast<std::int32_t>(z)) * 0x1p-23f - 127.0f;
      float y = std::bit_cast<float>(static_cast<std::int32_t>((127.0f - log2z * (1.0f / 12)) * 0x1p23f));
      for (int iteration = 0; iteration < 3; ++iteration) {
        const float y3 = y * y * y, y6 = y3 * y3;
        y *= (13.0f - z * (y6 * y6)) * (1.0f / 12);
      }
      const float y3 = y * y * y;
      const float power = 1.055f * (z * (y3 * y3 * y)) - 0.055f;
      const float encoded = x <= 0.0031308f ? 12.92f * x : power;
      const float rounded = 255.0f * encoded + offset[i];
      code[begin + i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(Min(Max(rounded, 0.0f), 255.0f)));
    }
  }
}

}  // namespace penumbra
