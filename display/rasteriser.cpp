#include "display/rasteriser.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <tuple>
#include <utility>

#include "display/glm_conversion.h"
#include "display/tile_grid.h"
#include "display/unit_vectors.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/scratch.h"

namespace penumbra {
namespace {

// Of two triangles that share an edge, one owns the pixels on it: for the other it is moved inwards by this
// [pixels]. Above the rounding of edge functions in a tile, so that the pixel goes to the same side all along
// the edge.
constexpr double kHalfOpen = 0x1p-14;

constexpr std::size_t kTrianglesPerBin = 1024;

// How far normals and heights of triangles may be apart that are culled together: unit vectors, and parts of
// the mesh's extent. Far above rounding; what they really are apart is counted when a cluster is culled.
constexpr double kFlat = 1e-9;
// A cluster is taken for turned away only beyond this part of its distance: above the rounding of that.
constexpr double kTurnedAway = 1e-12;

// A vertex in homogeneous picture coordinates: it projects to (x / z, y / z), z is its depth [m].
struct ScreenVertex {
  double x, y, z;
  double px, py;         // the projection, where z > 0
  std::uint8_t outside;  // a bit for each side of the picture's pyramid that it is beyond; kBehind
};
constexpr std::uint8_t kBehind = 16;

// The plane through the eye, b and a, as a function of picture coordinates.
Plane ScreenEdge(const ScreenVertex& a, const ScreenVertex& b) {
  // The operands of each product commute and nothing is contracted: ScreenEdge(b, a) is its exact negative.
  return {b.y * a.z - b.z * a.y, b.z * a.x - b.x * a.z, b.x * a.y - b.y * a.x};
}

// A plane with its slopes as tiles take them.
struct TilePlane {
  Plane plane;
  float x, y;
};

struct ScreenTriangle {
  TilePlane edge[3];    // signed distance [pixels], positive inside
  TilePlane inverse_z;  // [1/m]
  float max_inverse_z;
  std::uint32_t id;
  int x_begin, x_end, y_begin, y_end;  // pixels that it may cover
};

// The triangles that a consecutive range of indices contributes, and for each tile which of them meet it.
struct Bin {
  std::vector<ScreenTriangle> triangles;  // the first `count`
  std::size_t count = 0;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> hits;  // tile, index in `triangles`
  std::vector<std::uint32_t> first;                           // per tile: where its part of `sorted` begins
  std::vector<std::uint32_t> sorted;  // indices in `triangles`, ascending in each tile
  std::vector<float> nearest;         // per tile: the largest inverse_z there, or above it
};

// Triangles that follow one another in one plane: a patch, or part of it. They are culled together.
struct Cluster {
  std::uint32_t first_triangle, end_triangle;
  std::uint32_t first_vertex, end_vertex;
  glm::dvec3 normal{0.0};
  double deviation = 0;  // of the triangles' normals from it
  double low = 0;        // the least height of a vertex along it [m]
  glm::dvec3 centre{0.0};
  double radius = 0;  // of a ball that holds all vertices [m]
};

// The planes of the picture's pyramid as functions of directions from the eye, positive inside.
struct Pyramid {
  std::array<glm::dvec3, 5> side;  // left, right, top, bottom, front

  // Whether all of the ball is beyond one of them.
  bool Misses(const glm::dvec3& centre, double radius) const {
    return std::any_of(side.begin(), side.end(), [&](const glm::dvec3& s) {
      const double length = glm::length(s);
      return glm::dot(s, centre) <
             -(1 + kTurnedAway) * length * radius - kTurnedAway * length * glm::length(centre);
    });
  }
};

// Values keep their sign and need no digits beyond this: anywhere in a picture they are then floats.
constexpr double kLargest = 1e30;
static_assert(kLargest * (1 + 2 * kMaxPictureSize) < static_cast<double>(std::numeric_limits<float>::max()));

double Narrow(double value) { return std::clamp(value, -kLargest, kLargest); }
Plane Narrow(const Plane& f) { return {Narrow(f.x), Narrow(f.y), Narrow(f.c)}; }

TilePlane ForTiles(const Plane& f) {
  const Plane plane = Narrow(f);
  return {plane, static_cast<float>(plane.x), static_cast<float>(plane.y)};
}

TileTriangle::Affine ToTile(const TilePlane& f, int x, int y) {
  return {f.x, f.y, static_cast<float>(f.plane.At(x + 0.5, y + 0.5))};
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
  std::vector<glm::dvec3> positions;     // cluster by cluster
  std::vector<VertexIndices> triangles;  // indices in `positions`
  std::vector<Cluster> clusters;
  std::vector<std::size_t> first_cluster;  // of each bin, and the end

  // The picture that is being drawn.
  int width = 0, height = 0;
  TileGrid tiles;
  glm::dvec3 eye{0.0};
  Projection to_picture;
  Pyramid pyramid;
  std::vector<ScreenVertex> vertices;  // valid for clusters that may be seen
  std::vector<Bin> bins;
  std::vector<Plane> barycentric;  // three a triangle, valid for those in a bin: proportional to the
                                   // coordinates of its vertices, their sum is 1 / depth

  Impl(const std::vector<glm::dvec3>& all_positions, std::vector<VertexIndices> all_triangles);
  void AddCluster(std::size_t begin, std::size_t end, const std::vector<glm::dvec3>& all_positions,
                  std::vector<std::uint32_t>* local);
  void Aim(const PixelRays& rays);
  bool MayBeSeen(const Cluster& cluster) const;
  void Transform(const Cluster& cluster);
  bool SetUp(std::uint32_t id, ScreenTriangle* out);
  void Fill(std::size_t bin);
  void AddHits(const ScreenTriangle& triangle, std::uint32_t index, Bin* bin) const;
  void SortHits(Bin* bin) const;
  void Draw(const Bin& bin, std::size_t index, const RegionDepths& farthest, Tile* tile) const;
};

namespace {

// Twice the area, along the front's normal.
glm::dvec3 AreaNormal(const std::vector<glm::dvec3>& positions, const VertexIndices& t) {
  return glm::cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
}

glm::dvec3 NormalOf(const std::vector<glm::dvec3>& positions, const VertexIndices& t) {
  return StableNormalized(AreaNormal(positions, t));
}

}  // namespace

Rasteriser::Impl::Impl(const std::vector<glm::dvec3>& all_positions, std::vector<VertexIndices> all_triangles)
    : triangles(std::move(all_triangles)) {
  double extent = 0;
  for (const glm::dvec3& p : all_positions) extent = std::max(extent, glm::length(p - all_positions.front()));
  std::vector<std::uint32_t> local(all_positions.size(), kNoTriangle);
  first_cluster.push_back(0);
  for (std::size_t begin = 0; begin < triangles.size();) {
    // As many as lie in the plane of the first, up to the end of its bin.
    const std::size_t limit = std::min(triangles.size(), (begin / kTrianglesPerBin + 1) * kTrianglesPerBin);
    const glm::dvec3 normal = NormalOf(all_positions, triangles[begin]);
    const glm::dvec3& foot = all_positions[triangles[begin][0]];
    const auto fits = [&](const VertexIndices& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](std::uint32_t v) {
                           return std::abs(glm::dot(normal, all_positions[v] - foot)) <= kFlat * extent;
                         }) &&
             glm::length(NormalOf(all_positions, t) - normal) <= kFlat;
    };
    std::size_t end = begin + 1;
    while (end < limit && fits(triangles[end])) ++end;
    AddCluster(begin, end, all_positions, &local);
    begin = end;
    if (begin == limit) first_cluster.push_back(clusters.size());
  }
  vertices.resize(positions.size());
  barycentric.resize(3 * triangles.size());
  bins.resize(first_cluster.size() - 1);
}

// `local` is empty before and afterwards: where a vertex of the cluster is in `positions`.
void Rasteriser::Impl::AddCluster(std::size_t begin, std::size_t end,
                                  const std::vector<glm::dvec3>& all_positions,
                                  std::vector<std::uint32_t>* local) {
  Cluster cluster{};
  cluster.first_triangle = static_cast<std::uint32_t>(begin);
  cluster.end_triangle = static_cast<std::uint32_t>(end);
  cluster.first_vertex = static_cast<std::uint32_t>(positions.size());
  cluster.normal = NormalOf(all_positions, triangles[begin]);
  std::vector<std::uint32_t> used;
  for (std::size_t i = begin; i < end; ++i) {
    cluster.deviation =
        std::max(cluster.deviation, glm::length(NormalOf(all_positions, triangles[i]) - cluster.normal));
    for (std::uint32_t& v : triangles[i]) {
      std::uint32_t& place = (*local)[v];
      if (place == kNoTriangle) {
        place = static_cast<std::uint32_t>(positions.size());
        positions.push_back(all_positions[v]);
        used.push_back(v);
      }
      v = place;
    }
  }
  for (const std::uint32_t v : used) (*local)[v] = kNoTriangle;
  cluster.end_vertex = static_cast<std::uint32_t>(positions.size());
  glm::dvec3 low = positions[cluster.first_vertex], high = low;
  cluster.low = std::numeric_limits<double>::infinity();
  for (std::uint32_t v = cluster.first_vertex; v < cluster.end_vertex; ++v) {
    low = glm::min(low, positions[v]);
    high = glm::max(high, positions[v]);
    cluster.low = std::min(cluster.low, glm::dot(cluster.normal, positions[v]));
  }
  cluster.centre = 0.5 * (low + high);
  for (std::uint32_t v = cluster.first_vertex; v < cluster.end_vertex; ++v)
    cluster.radius = std::max(cluster.radius, glm::length(positions[v] - cluster.centre));
  clusters.push_back(cluster);
}

Rasteriser::Rasteriser(std::span<const Vec3> positions, std::vector<VertexIndices> triangles) {
  PENUMBRA_CHECK(triangles.size() < kNoTriangle);
  for (const VertexIndices& triangle : triangles)
    for (const std::uint32_t v : triangle) PENUMBRA_CHECK(v < positions.size());
  std::vector<glm::dvec3> vertices;
  vertices.reserve(positions.size());
  for (const Vec3& p : positions) vertices.push_back(ToGlm(p));
  impl_ = std::make_unique<Impl>(vertices, std::move(triangles));
}

Rasteriser::~Rasteriser() = default;
Rasteriser::Rasteriser(Rasteriser&&) noexcept = default;
Rasteriser& Rasteriser::operator=(Rasteriser&&) noexcept = default;

std::size_t Rasteriser::TriangleCount() const { return impl_->triangles.size(); }

void Rasteriser::Impl::Aim(const PixelRays& rays) {
  to_picture = MakeProjection(rays);
  eye = rays.eye;
  const auto& [x, y, depth] = to_picture;
  const double right = width, bottom = height;
  pyramid.side = {x, right * depth - x, y, bottom * depth - y, depth};
}

// False only where none of its triangles would be drawn.
bool Rasteriser::Impl::MayBeSeen(const Cluster& cluster) const {
  const glm::dvec3 centre = cluster.centre - eye;
  if (pyramid.Misses(centre, cluster.radius)) return false;
  // How far the eye is before the plane of any of the triangles, at most.
  const double reach = glm::length(centre) + cluster.radius;
  const double before = glm::dot(cluster.normal, eye) - cluster.low + cluster.deviation * reach;
  return before >= -kTurnedAway * (reach + glm::length(eye));
}

void Rasteriser::Impl::Transform(const Cluster& cluster) {
  for (std::uint32_t i = cluster.first_vertex; i < cluster.end_vertex; ++i) {
    const glm::dvec3 p = to_picture(positions[i] - eye);
    ScreenVertex v{p.x, p.y, p.z, 0, 0, 0};
    v.outside =
        static_cast<std::uint8_t>((v.x < 0 ? 1 : 0) | (v.x > width * v.z ? 2 : 0) | (v.y < 0 ? 4 : 0) |
                                  (v.y > height * v.z ? 8 : 0) | (v.z > 0 ? 0 : kBehind));
    if (v.z > 0) {
      const double inverse = 1 / v.z;
      v.px = v.x * inverse;
      v.py = v.y * inverse;
    }
    vertices[i] = v;
  }
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
    out->max_inverse_z = static_cast<float>(Narrow((1 + 0x1p-20) / std::min({a.z, b.z, c.z})));
  } else {
    out->x_begin = out->y_begin = 0;
    out->x_end = width;
    out->y_end = height;
    out->max_inverse_z = std::numeric_limits<float>::max();
  }

  // Each edge function is positive inside; edge k is opposite vertex k.
  const std::array<Plane, 3> edges = {ScreenEdge(b, c), ScreenEdge(c, a), ScreenEdge(a, b)};
  // Six times the volume that the triangle spans with the eye; positive in front of it.
  const double volume = edges[0].x * a.x + edges[0].y * a.y + edges[0].c * a.z;
  if (!(volume > 0)) return false;
  const double scale = 1 / volume;
  if (!std::isfinite(scale)) return false;

  Plane* coordinates = &barycentric[3 * static_cast<std::size_t>(id)];
  for (std::size_t k = 0; k < 3; ++k) {
    out->edge[k] = ForTiles(ToPixelDistance(edges[k]));
    coordinates[k] = Narrow(edges[k].Scaled(scale));
  }
  const Plane &p = coordinates[0], &q = coordinates[1], &r = coordinates[2];
  out->inverse_z = ForTiles({p.x + q.x + r.x, p.y + q.y + r.y, p.c + q.c + r.c});
  out->id = id;
  return true;
}

void Rasteriser::Impl::Fill(std::size_t bin_index) {
  Bin& bin = bins[bin_index];
  bin.count = 0;
  bin.hits.clear();
  for (std::size_t c = first_cluster[bin_index]; c < first_cluster[bin_index + 1]; ++c) {
    const Cluster& cluster = clusters[c];
    if (!MayBeSeen(cluster)) continue;
    Transform(cluster);
    for (std::uint32_t i = cluster.first_triangle; i < cluster.end_triangle; ++i) {
      // Set up where it stays: a copy of what was just written would wait for it.
      if (bin.count == bin.triangles.size()) bin.triangles.emplace_back();
      if (!SetUp(i, &bin.triangles[bin.count])) continue;
      AddHits(bin.triangles[bin.count], static_cast<std::uint32_t>(bin.count), &bin);
      ++bin.count;
    }
  }
  SortHits(&bin);
}

void Rasteriser::Impl::AddHits(const ScreenTriangle& triangle, std::uint32_t index, Bin* bin) const {
  const int x0 = triangle.x_begin / kTileSize, x1 = (triangle.x_end - 1) / kTileSize;
  const int y0 = triangle.y_begin / kTileSize, y1 = (triangle.y_end - 1) / kTileSize;
  const auto meets = [&](int tile_x, int tile_y) {
    for (const TilePlane& f : triangle.edge) {
      const Plane& edge = f.plane;
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
  bin->nearest.assign(tiles.Count(), 0.0f);
  for (const auto& [tile, index] : bin->hits)
    bin->nearest[tile] = std::max(bin->nearest[tile], bin->triangles[index].max_inverse_z);
}

void Rasteriser::Impl::Draw(const Bin& bin, std::size_t index, const RegionDepths& farthest,
                            Tile* tile) const {
  const int x0 = tile->x, x1 = std::min(x0 + kTileSize, width);
  const int y0 = tile->y, y1 = std::min(y0 + kTileSize, height);
  for (std::uint32_t k = bin.first[index]; k < bin.first[index + 1]; ++k) {
    const ScreenTriangle& triangle = bin.triangles[bin.sorted[k]];
    TileTriangle local;
    local.column_begin = std::max(triangle.x_begin, x0) - x0;
    local.column_end = std::min(triangle.x_end, x1) - x0;
    local.row_begin = std::max(triangle.y_begin, y0) - y0;
    local.row_end = std::min(triangle.y_end, y1) - y0;
    bool hidden = true;
    for (int y = local.row_begin / kRegionSize; y <= (local.row_end - 1) / kRegionSize; ++y)
      for (int x = local.column_begin / kRegionSize; x <= (local.column_end - 1) / kRegionSize; ++x)
        hidden =
            hidden && triangle.max_inverse_z < farthest[static_cast<std::size_t>(y * kRegionsAcross + x)];
    if (hidden) continue;
    for (std::size_t e = 0; e < 3; ++e) local.edge[e] = ToTile(triangle.edge[e], x0, y0);
    local.inverse_z = ToTile(triangle.inverse_z, x0, y0);
    local.max_inverse_z = triangle.max_inverse_z;
    local.id = triangle.id;
    DrawTileTriangle(local, tile);
  }
}

// Bins from the nearest to the farthest: what is drawn later is more often hidden altogether.
void Rasteriser::DrawTileIds(std::size_t index, Tile* tile) const {
  const Impl& impl = *impl_;
  tile->x = impl.tiles.X(index);
  tile->y = impl.tiles.Y(index);
  ClearTile(tile);
  // Beyond the picture's border nothing is far.
  if (tile->x + kTileSize > impl.width || tile->y + kTileSize > impl.height)
    for (int y = 0; y < kTileSize; ++y)
      for (int x = 0; x < kTileSize; ++x)
        if (tile->x + x >= impl.width || tile->y + y >= impl.height)
          tile->inverse_z[TileIndex(x, y) + x % kBlockSize] = std::numeric_limits<float>::max();
  const Scratch<std::vector<std::pair<float, const Bin*>>> scratch;
  std::vector<std::pair<float, const Bin*>>& order = *scratch;
  for (const Bin& bin : impl.bins)
    if (bin.first[index] < bin.first[index + 1]) order.emplace_back(-bin.nearest[index], &bin);
  std::sort(order.begin(), order.end());
  RegionDepths farthest{};
  for (std::size_t k = 0; k < order.size(); ++k) {
    impl.Draw(*order[k].second, index, farthest, tile);
    if (k + 1 < order.size()) FindFarthest(*tile, &farthest);
  }
}

void Rasteriser::DrawRowBarycentrics(BlockRow* row) const {
  FillBarycentrics(impl_->barycentric.data(), row);
}

void Rasteriser::Prepare(const PixelRays& rays, int width, int height) {
  PENUMBRA_CHECK(width > 0 && height > 0 && width <= kMaxPictureSize && height <= kMaxPictureSize);
  Impl& impl = *impl_;
  impl.width = width;
  impl.height = height;
  impl.tiles = TileGrid(width, height);
  impl.Aim(rays);
  ParallelFor(impl.bins.size(), 1, [&](std::size_t bin) { impl.Fill(bin); });
}

void Rasteriser::DrawTriangleIds(const PixelRays& rays, int width, int height, std::span<std::uint32_t> ids) {
  PENUMBRA_CHECK(ids.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Prepare(rays, width, height);
  const TileGrid& tiles = impl_->tiles;
  ParallelFor(tiles.Count(), 2, [&](std::size_t index) {
    Tile tile;
    DrawTileIds(index, &tile);
    ForEachPart(tiles, tile.x, tile.y, kTileSize, [&](std::size_t from, std::size_t to, std::size_t n) {
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
    ForEachBlockRow(tiles, index, [&](int x, int y) {
      BlockRow row;
      row.x = x;
      row.y = y;
      std::fill(std::begin(row.ids), std::end(row.ids), kNoTriangle);
      ForEachPart(tiles, x, y, kBlockSize, [&](std::size_t to, std::size_t from, std::size_t n) {
        CopyPart(ids.data() + from, n, row.ids + to);
        CopyPart(s.data() + from, n, row.s + to);
        CopyPart(t.data() + from, n, row.t + to);
      });
      FindRuns(&row);
      DrawRowBarycentrics(&row);
      ForEachPart(tiles, x, y, kBlockSize, [&](std::size_t from, std::size_t to, std::size_t n) {
        CopyPart(row.s + from, n, s.data() + to);
        CopyPart(row.t + from, n, t.data() + to);
      });
    });
  });
}

}  // namespace penumbra
