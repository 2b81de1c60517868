#include "display/vector_kernels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "display/rasteriser.h"
#include "solver/base/vector_dispatch.h"

namespace penumbra {
namespace {

// Where the pixels of a block lie in it. All loops below run over the pixels of one block or of two and have
// no branches: the compiler makes them vectors. (Vector types would be taken apart before the function is
// cloned for wider machines.)
constexpr auto kLaneX = [] {
  std::array<float, kBlockPixels> x{};
  for (int i = 0; i < kBlockPixels; ++i) x[static_cast<std::size_t>(i)] = static_cast<float>(i % kBlockSize);
  return x;
}();
constexpr auto kLaneY = [] {
  std::array<float, kBlockPixels> y{};
  for (int i = 0; i < kBlockPixels; ++i) y[static_cast<std::size_t>(i)] = static_cast<float>(i / kBlockSize);
  return y;
}();
constexpr auto kLaneBit = [] {
  std::array<std::uint32_t, kBlockPixels> bit{};
  for (std::size_t i = 0; i < kBlockPixels; ++i) bit[i] = 1u << i;
  return bit;
}();
constexpr std::uint32_t kAllLanes = (1u << kBlockPixels) - 1;

#define PENUMBRA_INLINE [[gnu::always_inline]] inline

PENUMBRA_INLINE float Min(float a, float b) { return a < b ? a : b; }
PENUMBRA_INLINE float Max(float a, float b) { return a > b ? a : b; }

PENUMBRA_INLINE float At(const TileTriangle::Affine& f, float x, float y) {
  return (f.c + f.y * y) + f.x * x;
}

// The largest and the least value over a block, as functions of its upper left pixel.
PENUMBRA_INLINE TileTriangle::Affine AtHighest(const TileTriangle::Affine& f) {
  return {f.x, f.y, f.c + (kBlockSize - 1) * (Max(f.x, 0) + Max(f.y, 0))};
}
PENUMBRA_INLINE TileTriangle::Affine AtLowest(const TileTriangle::Affine& f) {
  return {f.x, f.y, f.c + (kBlockSize - 1) * (Min(f.x, 0) + Min(f.y, 0))};
}

// 255 times the sRGB encoding of x in [0, 1]: below the knee by definition, above by the minimax polynomial
// in x^(1/4), which is within 3.6e-4 of it.
PENUMBRA_INLINE float Encode255(float x) {
  const float u = __builtin_sqrtf(__builtin_sqrtf(x));
  float power = 17.3930332f;
  power = power * u - 81.1960719f;
  power = power * u + 167.583004f;
  power = power * u - 217.504142f;
  power = power * u + 348.309864f;
  power = power * u + 35.5990554f;
  power = power * u - 15.1843853f;
  return x <= 0.0031308f ? 255 * 12.92f * x : power;
}

// In [0, 255], since offsets are below 0.995.
PENUMBRA_INLINE std::int32_t Dithered(float x, float offset) {
  return static_cast<std::int32_t>(Encode255(x) + offset);
}

// threshold[k]: the least float whose nearest code is k.
const std::array<float, 257> kThreshold = [] {
  std::array<float, 257> threshold{};
  threshold[0] = -std::numeric_limits<float>::infinity();
  threshold[256] = std::numeric_limits<float>::infinity();
  for (std::size_t k = 1; k < 256; ++k) {
    const long double encoded = (static_cast<long double>(k) - 0.5L) / 255;
    const long double linear =
        encoded <= 0.04045L ? encoded / 12.92L : std::pow((encoded + 0.055L) / 1.055L, 2.4L);
    threshold[k] = static_cast<float>(linear);
    if (static_cast<long double>(threshold[k]) < linear)
      threshold[k] = std::nextafter(threshold[k], std::numeric_limits<float>::infinity());
  }
  return threshold;
}();

// The code that the polynomial gives is one off at most.
PENUMBRA_INLINE std::int32_t Nearest(float x) {
  const std::int32_t code = Dithered(x, 0.5f);
  const auto k = static_cast<std::size_t>(code);
  return code + (x >= kThreshold[k + 1] ? 1 : 0) - (x < kThreshold[k] ? 1 : 0);
}

PENUMBRA_INLINE std::uint32_t Code(std::int32_t r, std::int32_t g, std::int32_t b) {
  return static_cast<std::uint32_t>(r | (g << 8) | (b << 16));
}

// What shows, linear and in [0, 1], where the value is `value`.
PENUMBRA_INLINE float Exposed(float value, float exposure, float background) {
  const float surface = Min(value * exposure, 1.0f);
  return value < 0 ? background : surface;
}

// Four pixels are three words: `codes` of 4 n pixels, `words` 3 n.
PENUMBRA_INLINE void PackWords(const std::uint32_t* __restrict codes, std::size_t n,
                               std::uint32_t* __restrict words) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t p = codes[4 * i], q = codes[4 * i + 1], r = codes[4 * i + 2], s = codes[4 * i + 3];
    words[3 * i] = p | (q << 24);
    words[3 * i + 1] = (q >> 8) | (r << 16);
    words[3 * i + 2] = (r >> 16) | (s << 8);
  }
}

}  // namespace

void ClearTile(Tile* tile) {
  std::fill(std::begin(tile->inverse_z), std::end(tile->inverse_z), 0.0f);
  std::fill(std::begin(tile->ids), std::end(tile->ids), kNoTriangle);
}

PENUMBRA_VECTOR_CLONES
void DrawTileTriangle(const TileTriangle& triangle, Tile* tile) {
  const TileTriangle::Affine e0 = triangle.edge[0], e1 = triangle.edge[1], e2 = triangle.edge[2];
  const TileTriangle::Affine inverse_z = triangle.inverse_z;
  const float w_max = triangle.max_inverse_z;
  const std::uint32_t id = triangle.id;
  const auto column_begin = static_cast<float>(triangle.column_begin),
             column_end = static_cast<float>(triangle.column_end),
             row_begin = static_cast<float>(triangle.row_begin),
             row_end = static_cast<float>(triangle.row_end);
  const int x_begin = triangle.column_begin / kBlockSize, x_end = (triangle.column_end - 1) / kBlockSize + 1;
  const int y_begin = triangle.row_begin / kBlockSize, y_end = (triangle.row_end - 1) / kBlockSize + 1;
  const TileTriangle::Affine high0 = AtHighest(e0), high1 = AtHighest(e1), high2 = AtHighest(e2);
  const TileTriangle::Affine low0 = AtLowest(e0), low1 = AtLowest(e1), low2 = AtLowest(e2);
  // A group of 4 x 4 blocks is looked at together: most triangles are not larger.
  for (int group_y = y_begin; group_y < y_end; group_y += kBlockSize)
    for (int group_x = x_begin; group_x < x_end; group_x += kBlockSize) {
      // Margins of two fringes, far above the rounding of these sums.
      std::uint32_t lanes = 0;  // that it meets, and, 16 bits higher, those that it covers
      for (std::size_t i = 0; i < kBlockPixels; ++i) {
        const float x = static_cast<float>(group_x * kBlockSize) + kBlockSize * kLaneX[i];
        const float y = static_cast<float>(group_y * kBlockSize) + kBlockSize * kLaneY[i];
        const float high = Min(At(high0, x, y), Min(At(high1, x, y), At(high2, x, y)));
        const float low = Min(At(low0, x, y), Min(At(low1, x, y), At(low2, x, y)));
        const bool met = (high >= -2 * kFringe) & (x < column_end) & (y < row_end);
        lanes |= (met ? kLaneBit[i] : 0) | (low > 2 * kFringe ? kLaneBit[i] << kBlockPixels : 0);
      }
      for (std::uint32_t meets = lanes & kAllLanes; meets != 0; meets &= meets - 1) {
        const int block = std::countr_zero(meets);
        const int bx = group_x + block % kBlockSize, by = group_y + block / kBlockSize;
        const auto left = static_cast<float>(bx * kBlockSize), top = static_cast<float>(by * kBlockSize);
        const int at = (by * kBlocksAcross + bx) * kBlockPixels;
        float* __restrict z = tile->inverse_z + at;
        std::uint32_t* __restrict ids = tile->ids + at;
        if ((lanes >> block >> kBlockPixels & 1) != 0) {
          for (std::size_t i = 0; i < kBlockPixels; ++i) {
            const float w = Min(At(inverse_z, left + kLaneX[i], top + kLaneY[i]), w_max);
            const bool nearer = (w > z[i]) | ((w == z[i]) & (id < ids[i]));
            z[i] = nearer ? w : z[i];
            ids[i] = nearer ? id : ids[i];
          }
          continue;
        }
        for (std::size_t i = 0; i < kBlockPixels; ++i) {
          const float x = left + kLaneX[i], y = top + kLaneY[i];
          const float w = Min(At(inverse_z, x, y), w_max);
          const float inside = Min(At(e0, x, y), Min(At(e1, x, y), At(e2, x, y)));
          const float w_drawn = w + w * Min(inside, 0.0f);
          const bool nearer = (w_drawn > z[i]) | ((w_drawn == z[i]) & (id < ids[i]));
          const bool drawn = (inside >= -kFringe) & nearer & (x >= column_begin) & (x < column_end) &
                             (y >= row_begin) & (y < row_end);
          z[i] = drawn ? w_drawn : z[i];
          ids[i] = drawn ? id : ids[i];
        }
      }
    }
}

PENUMBRA_VECTOR_CLONES
void FindFarthest(const Tile& tile, RegionDepths* farthest) {
  constexpr int kBlocks = kRegionSize / kBlockSize;  // of a region, a side
  for (int region = 0; region < kRegionsAcross * kRegionsAcross; ++region) {
    alignas(64) float least[kBlockPixels];
    std::fill(std::begin(least), std::end(least), std::numeric_limits<float>::max());
    const int first = region / kRegionsAcross * kBlocks * kBlocksAcross + region % kRegionsAcross * kBlocks;
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      const float* z =
          tile.inverse_z + (first + block / kBlocks * kBlocksAcross + block % kBlocks) * kBlockPixels;
      for (int i = 0; i < kBlockPixels; ++i) least[i] = Min(least[i], z[i]);
    }
    float least_of_all = least[0];
    for (const float z : least) least_of_all = Min(least_of_all, z);
    (*farthest)[static_cast<std::size_t>(region)] = least_of_all;
  }
}

PENUMBRA_VECTOR_CLONES
void FindRuns(BlockRow* row) {
  int count = 0;
  for (int block = 0; block < kBlocksAcross; ++block) {
    const std::uint32_t* ids = row->ids + block * kBlockPixels;
    for (std::uint32_t open = kAllLanes; open != 0;) {
      const std::uint32_t id = ids[std::countr_zero(open)];
      std::uint32_t same = 0;
      for (std::size_t i = 0; i < kBlockPixels; ++i) same |= ids[i] == id ? kLaneBit[i] : 0;
      row->runs[count++] = {id, static_cast<std::uint16_t>(block)};
      open &= ~same;
    }
  }
  row->run_count = count;
}

PENUMBRA_VECTOR_CLONES
void FillBarycentrics(const Plane* planes, BlockRow* row) {
  for (int r = 0; r < row->run_count; ++r) {
    const BlockRun run = row->runs[r];
    if (run.id == kNoTriangle) continue;
    const Plane* plane = planes + 3 * static_cast<std::size_t>(run.id);
    const double x = row->x + run.block * kBlockSize + 0.5;
    const double y = row->y + 0.5;
    TileTriangle::Affine f[3];
    for (int k = 0; k < 3; ++k) {
      f[k] = {static_cast<float>(plane[k].x), static_cast<float>(plane[k].y),
              static_cast<float>(plane[k].At(x, y))};
    }
    const TileTriangle::Affine f0 = f[0], f1 = f[1], f2 = f[2];
    const int at = run.block * kBlockPixels;
    const std::uint32_t id = run.id;
    const std::uint32_t* __restrict ids = row->ids + at;
    float* __restrict s = row->s + at;
    float* __restrict t = row->t + at;
    for (std::size_t i = 0; i < kBlockPixels; ++i) {
      const float b0 = Max(At(f0, kLaneX[i], kLaneY[i]), 0.0f), b1 = Max(At(f1, kLaneX[i], kLaneY[i]), 0.0f),
                  b2 = Max(At(f2, kLaneX[i], kLaneY[i]), 0.0f);
      const float scale = 1.0f / Max(b0 + b1 + b2, std::numeric_limits<float>::min());
      const bool here = ids[i] == id;
      s[i] = here ? b1 * scale : s[i];
      t[i] = here ? b2 * scale : t[i];
    }
  }
}

PENUMBRA_VECTOR_CLONES
void EvaluateRadiosity(const TriangleShade* shades, float background, BlockRow* row) {
  for (int r = 0; r < row->run_count; ++r) {
    const BlockRun run = row->runs[r];
    const int at = run.block * kBlockPixels;
    const std::uint32_t id = run.id;
    const std::uint32_t* __restrict ids = row->ids + at;
    if (id == kNoTriangle) {
      for (auto& channel : row->rgb) {
        float* __restrict out = channel + at;
        for (int i = 0; i < kBlockPixels; ++i) out[i] = ids[i] == id ? background : out[i];
      }
      continue;
    }
    const TriangleShade& shade = shades[id];
    const float* __restrict s = row->s + at;
    const float* __restrict t = row->t + at;
    for (int channel = 0; channel < 3; ++channel) {
      const float a = shade.a[channel], b2 = shade.b2[channel], c2 = shade.c2[channel];
      const float d = shade.d[channel], e2 = shade.e2[channel], f = shade.f[channel];
      const float reflectance = shade.reflectance[channel], emittance = shade.emittance[channel];
      float* __restrict out = row->rgb[channel] + at;
      for (int i = 0; i < kBlockPixels; ++i) {
        const float irradiance = (a * s[i] + b2 * t[i] + c2) * s[i] + (d * t[i] + e2) * t[i] + f;
        const float radiosity = Max(irradiance, 0.0f) * reflectance + emittance;
        out[i] = ids[i] == id ? radiosity : out[i];
      }
    }
  }
}

ScreenTransfer::ScreenTransfer(float the_exposure, float the_background, const float* dither)
    : exposure(the_exposure), background(the_background), dithered(dither != nullptr) {
  if (!dithered) return;
  for (int half = 0; half < 2; ++half)
    for (int i = 0; i < 2 * kBlockPixels; ++i) {
      const int x = i / kBlockPixels * kBlockSize + i % kBlockSize;
      const int y = half * kBlockSize + i % kBlockPixels / kBlockSize;
      offset[half][i] = dither[8 * y + x];
    }
}

PENUMBRA_VECTOR_CLONES
void FillScreen(const ScreenTransfer& transfer, BlockRow* row) {
  constexpr int kPair = 2 * kBlockPixels;
  const float exposure = transfer.exposure, background = transfer.background;
  const float* __restrict offset = transfer.offset[row->y / kBlockSize % 2];
  for (int begin = 0; begin < kRowPixels; begin += kPair) {
    alignas(64) std::int32_t codes[3][kPair];
    for (int channel = 0; channel < 3; ++channel) {
      const float* __restrict value = row->rgb[channel] + begin;
      std::int32_t* __restrict code = codes[channel];
      if (transfer.dithered)
        for (int i = 0; i < kPair; ++i)
          code[i] = Dithered(Exposed(value[i], exposure, background), offset[i]);
      else
        for (int i = 0; i < kPair; ++i) code[i] = Nearest(Exposed(value[i], exposure, background));
    }
    std::uint32_t* __restrict screen = row->screen + begin;
    for (int i = 0; i < kPair; ++i) screen[i] = Code(codes[0][i], codes[1][i], codes[2][i]);
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
void EncodeRow(const float* __restrict red, const float* __restrict green, const float* __restrict blue,
               std::size_t n, const float* __restrict dither, std::uint32_t* __restrict codes) {
  if (dither == nullptr) {
    for (std::size_t i = 0; i < n; ++i) codes[i] = Code(Nearest(red[i]), Nearest(green[i]), Nearest(blue[i]));
    return;
  }
  std::size_t begin = 0;
  for (; begin + 8 <= n; begin += 8)
    for (std::size_t i = 0; i < 8; ++i)
      codes[begin + i] = Code(Dithered(red[begin + i], dither[i]), Dithered(green[begin + i], dither[i]),
                              Dithered(blue[begin + i], dither[i]));
  for (std::size_t i = begin; i < n; ++i)
    codes[i] = Code(Dithered(red[i], dither[i - begin]), Dithered(green[i], dither[i - begin]),
                    Dithered(blue[i], dither[i - begin]));
}

PENUMBRA_VECTOR_CLONES
void PackRow(const std::uint32_t* codes, std::size_t n, std::uint8_t* bytes) {
  constexpr std::size_t kAtOnce = kTileSize;  // pixels
  for (std::size_t begin = 0; begin < n; begin += kAtOnce) {
    alignas(64) std::uint32_t some[kAtOnce] = {}, words[kAtOnce / 4 * 3];
    const std::size_t count = std::min(kAtOnce, n - begin);
    std::memcpy(some, codes + begin, count * sizeof(some[0]));
    PackWords(some, kAtOnce / 4, words);
    std::memcpy(bytes + 3 * begin, words, 3 * count);
  }
}

PENUMBRA_VECTOR_CLONES
void PackScreen(const BlockRow& row, int y, std::size_t n, std::uint8_t* bytes) {
  alignas(64) std::uint32_t codes[kTileSize], words[kTileSize / 4 * 3];
  for (int x = 0; x < kTileSize; x += kBlockSize)
    std::memcpy(codes + x, row.screen + TileIndex(x, y), kBlockSize * sizeof(codes[0]));
  PackWords(codes, kTileSize / 4, words);
  std::memcpy(bytes, words, 3 * n);
}

}  // namespace penumbra
