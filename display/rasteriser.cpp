#include "display/rasteriser.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "display/tile_grid.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// Of two triangles that share an edge, one owns the pixels on it: for the other it is moved inwards by this
// [pixels]. Above the rounding of edge functions in a tile, so that the pixel goes to the same side all along
// the edge.
constexpr double kHalfOpen = 0x1p-14;

constexpr std::size_t kTrianglesPerBin = 1024;
constexpr std::size_t kVerticesPerTask = 4096;

// A vertex in homogeneous picture coordinates: it projects to (x / z, y / z), z is its depth [m].
struct ScreenVertex {
  double x, y, z;
  double px, py;         // the projection, where z > 0
  std::uint8_t outside;  // a bit for each side of the picture's pyramid that it is beyond; kBehind
};
constexpr std::uint8_t kBehind = 16;

// The plane through the eye, b and a, as a function of picture coordinates.
Plane EdgePlane(const ScreenVertex& a, const ScreenVertex& b) {
  // The operands of each product commute and nothing is contracted: EdgePlane(b, a) is its exact negative.
  return {b.y * a.z - b.z * a.y, b.z * a.x - b.x * a.z, b.x * a.y - b.y * a.x};
}

struct ScreenTriangle {
  Plane edge[3];    // signed distance [pixels], positive inside
  Plane inverse_z;  // [1/m]
  float max_inverse_z;
  std::uint32_t id;
  int x_begin, x_end, y_begin, y_end;  // pixels that it may cover
};

// The triangles that a consecutive range of indices contributes, and for each tile which of them meet it.
struct Bin {
  std::vector<ScreenTriangle> triangles;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hits;  // tile, index in `triangles`
  std::vector<std::uint32_t> first;                           // per tile: where its part of `sorted` begins
  std::vector<std::uint32_t> sorted;  // indices in `triangles`, ascending in each tile
};

// Floats that keep their sign and need no digits beyond this.
float Narrow(double value) { return static_cast<float>(std::clamp(value, -1e30, 1e30)); }

TileTriangle::Affine ToTile(const Plane& plane, int x, int y) {
  return {Narrow(plane.x), Narrow(plane.y), Narrow(plane.At(x + 0.5, y + 0.5))};
}

// The half-open rule: of an edge's two directions one is exclusive.
bool IsExclusive(const Plane& edge) { return edge.x < 0 || (edge.x == 0 && edge.y < 0); }

Plane ToPixelDistance(const Plane& edge) {
  const double gradient = std::max(std::sqrt(edge.x * edge.x + edge.y * edge.y), 1e-150);
  Plane distance = edge.Scaled(1 / gradient);
  if (IsExclusive(edge)) distance.c -= kHalfOpen;
  return distance;
}

// The first and one past the last pixel whose centre may lie in [low, high] or its fringe, within [0, size).
std::pair<int, int> PixelRange(double low, double high, int size) {
  const double limit = size;
  return {static_cast<int>(std::ceil(std::clamp(low - 0.5 - static_cast<double>(kFringe), 0.0, limit))),
          static_cast<int>(std::floor(std::clamp(high + 0.5 + static_cast<double>(kFringe), 0.0, limit)))};
}

}  // namespace

struct Rasteriser::Impl {
  std::vector<Vec3> positions;
  std::vector<VertexIndices> triangles;

  // The picture that is being drawn.
  int width = 0, height = 0;
  TileGrid tiles;
  std::vector<ScreenVertex> vertices;
  std::vector<Bin> bins;
  std::vector<Plane> barycentric;  // three a triangle, valid for those in a bin: proportional to the
                                   // coordinates of its vertices, their sum is 1 / depth

  void Transform(const PixelRays& rays);
  bool SetUp(std::uint32_t id, ScreenTriangle* out);
  void Fill(std::size_t bin);
  void AddHits(const ScreenTriangle& triangle, std::uint32_t index, Bin* bin) const;
  void SortHits(Bin* bin) const;
};

Rasteriser::Rasteriser(std::vector<Vec3> positions, std::vector<VertexIndices> triangles)
    : impl_(std::make_unique<Impl>()) {
  PENUMBRA_CHECK(triangles.size() < kNoTriangle);
  for (const VertexIndices& triangle : triangles)
    for (const std::uint32_t v : triangle) PENUMBRA_CHECK(v < positions.size());
  impl_->vertices.resize(positions.size());
  impl_->barycentric.resize(3 * triangles.size());
  impl_->bins.resize((triangles.size() + kTrianglesPerBin - 1) / kTrianglesPerBin);
  impl_->positions = std::move(positions);
  impl_->triangles = std::move(triangles);
}

Rasteriser::~Rasteriser() = default;
Rasteriser::Rasteriser(Rasteriser&&) noexcept = default;
Rasteriser& Rasteriser::operator=(Rasteriser&&) noexcept = default;

std::size_t Rasteriser::TriangleCount() const { return impl_->triangles.size(); }

void Rasteriser::Impl::Transform(const PixelRays& rays) {
  Eigen::Matrix3d to_space;
  to_space << rays.dx, rays.dy, rays.corner;
  const Eigen::Matrix3d to_picture = to_space.inverse();
  ParallelFor(positions.size(), kVerticesPerTask, [&](std::size_t i) {
    const Vec3 p = to_picture * (positions[i] - rays.eye);
    ScreenVertex v{p.x(), p.y(), p.z(), 0, 0, 0};
    v.outside =
        static_cast<std::uint8_t>((v.x < 0 ? 1 : 0) | (v.x > width * v.z ? 2 : 0) | (v.y < 0 ? 4 : 0) |
                                  (v.y > height * v.z ? 8 : 0) | (v.z > 0 ? 0 : kBehind));
    if (v.z > 0) {
      const double inverse = 1 / v.z;
      v.px = v.x * inverse;
      v.py = v.y * inverse;
    }
    vertices[i] = v;
  });
}

// Prepares a triangle; false if it cannot be seen.
bool Rasteriser::Impl::SetUp(std::uint32_t id, ScreenTriangle* out) {
  const auto& [i0, i1, i2] = triangles[id];
  const ScreenVertex &a = vertices[i0], &b = vertices[i1], &c = vertices[i2];
  if ((a.outside & b.outside & c.outside) != 0) return false;

  const bool in_front = ((a.outside | b.outside | c.outside) & kBehind) == 0;
  if (in_front) {
    const auto [x_low, x_high] = std::minmax({a.px, b.px, c.px});
    const auto [y_low, y_high] = std::minmax({a.py, b.py, c.py});
    std::tie(out->x_begin, out->x_end) = PixelRange(x_low, x_high, width);
    std::tie(out->y_begin, out->y_end) = PixelRange(y_low, y_high, height);
    if (out->x_begin >= out->x_end || out->y_begin >= out->y_end) return false;
    out->max_inverse_z = Narrow((1 + 0x1p-20) / std::min({a.z, b.z, c.z}));
  } else {
    out->x_begin = out->y_begin = 0;
    out->x_end = width;
    out->y_end = height;
    out->max_inverse_z = std::numeric_limits<float>::max();
  }

  // Each edge function is positive inside; edge k is opposite vertex k.
  const std::array<Plane, 3> edges = {EdgePlane(b, c), EdgePlane(c, a), EdgePlane(a, b)};
  // Six times the volume that the triangle spans with the eye; positive in front of it.
  const double volume = edges[0].x * a.x + edges[0].y * a.y + edges[0].c * a.z;
  if (!(volume > 0)) return false;
  const double scale = 1 / volume;
  if (!std::isfinite(scale)) return false;

  Plane* coordinates = &barycentric[3 * static_cast<std::size_t>(id)];
  for (std::size_t k = 0; k < 3; ++k) {
    out->edge[k] = ToPixelDistance(edges[k]);
    coordinates[k] = edges[k].Scaled(scale);
  }
  const Plane &p = coordinates[0], &q = coordinates[1], &r = coordinates[2];
  out->inverse_z = {p.x + q.x + r.x, p.y + q.y + r.y, p.c + q.c + r.c};
  out->id = id;
  return true;
}

void Rasteriser::Impl::Fill(std::size_t bin_index) {
  Bin& bin = bins[bin_index];
  bin.triangles.clear();
  bin.hits.clear();
  const std::size_t begin = bin_index * kTrianglesPerBin;
  const std::size_t end = std::min(triangles.size(), begin + kTrianglesPerBin);
  for (std::size_t i = begin; i < end; ++i) {
    ScreenTriangle triangle;
    if (!SetUp(static_cast<std::uint32_t>(i), &triangle)) continue;
    AddHits(triangle, static_cast<std::uint32_t>(bin.triangles.size()), &bin);
    bin.triangles.push_back(triangle);
  }
  SortHits(&bin);
}

void Rasteriser::Impl::AddHits(const ScreenTriangle& triangle, std::uint32_t index, Bin* bin) const {
  const int x0 = triangle.x_begin / kTileSize, x1 = (triangle.x_end - 1) / kTileSize;
  const int y0 = triangle.y_begin / kTileSize, y1 = (triangle.y_end - 1) / kTileSize;
  const auto meets = [&](int tile_x, int tile_y) {
    for (const Plane& edge : triangle.edge) {
      // The edge function at the pixel centre of the tile where it is largest.
      const double x = tile_x * kTileSize + (edge.x > 0 ? kTileSize - 0.5 : 0.5);
      const double y = tile_y * kTileSize + (edge.y > 0 ? kTileSize - 0.5 : 0.5);
      if (edge.At(x, y) < -2 * static_cast<double>(kFringe)) return false;
    }
    return true;
  };
  const bool one_tile = x0 == x1 && y0 == y1;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if (one_tile || meets(x, y))
        bin->hits.emplace_back(static_cast<std::uint32_t>(y * tiles.across + x), index);
}

// A counting sort by tile, stable: within a tile triangles keep their order.
void Rasteriser::Impl::SortHits(Bin* bin) const {
  bin->first.assign(tiles.Count() + 1, 0);
  for (const auto& [tile, index] : bin->hits) ++bin->first[tile];
  std::uint32_t sum = 0;
  for (std::uint32_t& count : bin->first) count = std::exchange(sum, sum + count);
  bin->sorted.resize(bin->hits.size());
  for (const auto& [tile, index] : bin->hits) bin->sorted[bin->first[tile]++] = index;
  // Each entry now holds its tile's end, which is the next one's beginning.
  for (std::size_t tile = bin->first.size() - 1; tile > 0; --tile) bin->first[tile] = bin->first[tile - 1];
  bin->first[0] = 0;
}

void Rasteriser::DrawTileIds(std::size_t index, Tile* tile) const {
  const Impl& impl = *impl_;
  tile->x = impl.tiles.X(index);
  tile->y = impl.tiles.Y(index);
  ClearTile(tile);
  const int x0 = tile->x, x1 = std::min(x0 + kTileSize, impl.width);
  const int y0 = tile->y, y1 = std::min(y0 + kTileSize, impl.height);
  for (const Bin& bin : impl.bins)
    for (std::uint32_t k = bin.first[index]; k < bin.first[index + 1]; ++k) {
      const ScreenTriangle& triangle = bin.triangles[bin.sorted[k]];
      TileTriangle local;
      for (std::size_t e = 0; e < 3; ++e) local.edge[e] = ToTile(triangle.edge[e], x0, y0);
      local.inverse_z = ToTile(triangle.inverse_z, x0, y0);
      local.max_inverse_z = triangle.max_inverse_z;
      local.id = triangle.id;
      local.column_begin = std::max(triangle.x_begin, x0) - x0;
      local.column_end = std::min(triangle.x_end, x1) - x0;
      local.row_begin = std::max(triangle.y_begin, y0) - y0;
      local.row_end = std::min(triangle.y_end, y1) - y0;
      DrawTileTriangle(local, tile);
    }
}

void Rasteriser::DrawTileBarycentrics(Tile* tile) const { FillBarycentrics(impl_->barycentric.data(), tile); }

void Rasteriser::Prepare(const PixelRays& rays, int width, int height) {
  PENUMBRA_CHECK(width > 0 && height > 0 && width <= kMaxPictureSize && height <= kMaxPictureSize);
  Impl& impl = *impl_;
  impl.width = width;
  impl.height = height;
  impl.tiles = TileGrid(width, height);
  impl.Transform(rays);
  ParallelFor(impl.bins.size(), 1, [&](std::size_t bin) { impl.Fill(bin); });
}

void Rasteriser::DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) {
  PENUMBRA_CHECK(ids.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Prepare(rays, width, height);
  const TileGrid& tiles = impl_->tiles;
  ParallelFor(tiles.Count(), 2, [&](std::size_t index) {
    Tile tile;
    DrawTileIds(index, &tile);
    ForEachTilePart(tiles, tile.x, tile.y, [&](std::size_t from, std::size_t to, std::size_t n) {
      CopyPart(tile.ids + from, n, ids.data() + to);
    });
  });
}

void Rasteriser::DrawBarycentrics(std::span<const std::uint32_t> ids, std::span<float> s,
                                  std::span<float> t) {
  const TileGrid& tiles = impl_->tiles;
  PENUMBRA_CHECK(ids.size() ==
                 static_cast<std::size_t>(tiles.width) * static_cast<std::size_t>(tiles.height));
  PENUMBRA_CHECK(s.size() == ids.size() && t.size() == ids.size());
  ParallelFor(tiles.Count(), 2, [&](std::size_t index) {
    Tile tile;
    tile.x = tiles.X(index);
    tile.y = tiles.Y(index);
    std::fill(std::begin(tile.ids), std::end(tile.ids), kNoTriangle);
    ForEachTilePart(tiles, tile.x, tile.y, [&](std::size_t to, std::size_t from, std::size_t n) {
      CopyPart(ids.data() + from, n, tile.ids + to);
      CopyPart(s.data() + from, n, tile.s + to);
      CopyPart(t.data() + from, n, tile.t + to);
    });
    FindRuns(&tile);
    DrawTileBarycentrics(&tile);
    ForEachTilePart(tiles, tile.x, tile.y, [&](std::size_t from, std::size_t to, std::size_t n) {
      CopyPart(tile.s + from, n, s.data() + to);
      CopyPart(tile.t + from, n, t.data() + to);
    });
  });
}

}  // namespace penumbra
