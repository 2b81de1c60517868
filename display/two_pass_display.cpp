#include "display/two_pass_display.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <utility>

#include "display/glm_conversion.h"
#include "display/tile_grid.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kCacheLine = 64;  // bytes

// Of this many rows of blocks one is timed part by part: looks at the clock would take as long as some parts.
constexpr int kTimedRow = 4;

// Milliseconds since the last call, or since it was made.
class Lap {
 public:
  double operator()() {
    const Clock::time_point now = Clock::now(), last = std::exchange(last_, now);
    return std::chrono::duration<double, std::milli>(now - last).count();
  }

 private:
  Clock::time_point last_ = Clock::now();
};

void Store(const Rgb& rgb, float* out) {
  const glm::vec3 pixel = ToPixel(rgb);
  for (int c = 0; c < 3; ++c) out[c] = pixel[c];
}

TriangleShade MakeShade(const QuadraticInterpolant& irradiance, const Material& material) {
  TriangleShade shade{};
  Store(irradiance.a, shade.a);
  Store(irradiance.b2, shade.b2);
  Store(irradiance.c2, shade.c2);
  Store(irradiance.d, shade.d);
  Store(irradiance.e2, shade.e2);
  Store(irradiance.f, shade.f);
  Store(material.reflectance, shade.reflectance);
  Store(material.emittance, shade.emittance);
  return shade;
}

// No irradiance, and the reflectance in the emittance's place.
TriangleShade MakeReflectanceShade(const Material& material) {
  TriangleShade shade{};
  Store(material.reflectance, shade.emittance);
  return shade;
}

}  // namespace

std::unique_ptr<Passes> SoftwarePasses(const IrradianceMesh& mesh) {
  std::vector<VertexIndices> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const IrradianceMesh::Triangle& triangle : mesh.triangles) triangles.push_back(triangle.vertex);
  return std::make_unique<Rasteriser>(mesh.positions, std::move(triangles));
}

TwoPassDisplay::TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh)
    : TwoPassDisplay(scene, mesh, SoftwarePasses(mesh)) {}

TwoPassDisplay::TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh, std::unique_ptr<Passes> passes)
    : passes_(std::move(passes)), rasteriser_(dynamic_cast<Rasteriser*>(passes_.get())) {
  PENUMBRA_CHECK(mesh.irradiance.size() == mesh.triangles.size());
  radiosity_.reserve(mesh.triangles.size());
  reflectance_.reserve(mesh.triangles.size());
  kind_.reserve(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const PatchId patch = mesh.triangles[i].patch;
    PENUMBRA_CHECK(patch >= 0 && static_cast<std::size_t>(patch) < scene.patches.size());
    const Material& material = scene.MaterialOf(patch);
    radiosity_.push_back(MakeShade(mesh.irradiance[i], material));
    reflectance_.push_back(MakeReflectanceShade(material));
    kind_.push_back((material.emittance > 0).any() ? PixelKind::kEmitter : PixelKind::kSurface);
  }
  screen_ = radiosity_;
  for (std::size_t i = 0; i < screen_.size(); ++i)
    if (kind_[i] == PixelKind::kEmitter)
      std::fill_n(screen_[i].emittance, 3, std::numeric_limits<float>::infinity());
}

// Pass one and two, or the preparations for them.
void TwoPassDisplay::DrawPasses(const Camera& camera, int width, int height) {
  const PixelRays rays = MakePixelRays(camera, width, height);
  frame_.width = width;
  frame_.height = height;
  frame_.ms = {};
  Lap lap;
  if (rasteriser_) {
    rasteriser_->Prepare(rays, width, height);
    frame_.ms.triangle_ids = lap();
    return;
  }
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  frame_.triangle.resize(pixels);
  frame_.s.resize(pixels);
  frame_.t.resize(pixels);
  passes_->DrawTriangleIds(rays, width, height, frame_.triangle);
  frame_.ms.triangle_ids = lap();
  passes_->DrawBarycentrics(frame_.triangle, frame_.s, frame_.t);
  frame_.ms.barycentric = lap();
}

// Calls finish(row) for all rows of blocks, with `rgb` evaluated, and counts its time as `finishing`.
template <class Finish>
void TwoPassDisplay::DrawTiles(const std::vector<TriangleShade>& shades, float background,
                               double FrameTimes::*finishing, const Finish& finish) {
  const TileGrid tiles(frame_.width, frame_.height);
  tile_times_.assign(tiles.Count(), {});
  Lap wall;
  ParallelFor(tiles.Count(), 1, [&](std::size_t index) {
    Lap lap;
    Tile tile;
    if (rasteriser_) rasteriser_->DrawTileIds(index, &tile);
    FrameTimes& times = tile_times_[index];
    const double ids = rasteriser_ ? lap() : 0;
    ForEachBlockRow(tiles, index, [&](int x, int y) {
      std::optional<Lap> part;
      if (y / kBlockSize % kTimedRow == 0) part.emplace();
      const auto count = [&](double FrameTimes::*as) {
        if (part) times.*as += (*part)();
      };
      BlockRow row;
      row.x = x;
      row.y = y;
      if (rasteriser_) {
        std::copy_n(tile.ids + (y - tile.y) / kBlockSize * kRowPixels, kRowPixels, row.ids);
        FindRuns(&row);
        count(&FrameTimes::triangle_ids);
        rasteriser_->DrawRowBarycentrics(&row);
        count(&FrameTimes::barycentric);
      } else {
        std::fill(std::begin(row.ids), std::end(row.ids), kNoTriangle);
        ForEachPart(tiles, x, y, kBlockSize, [&](std::size_t to, std::size_t from, std::size_t n) {
          CopyPart(frame_.triangle.data() + from, n, row.ids + to);
          CopyPart(frame_.s.data() + from, n, row.s + to);
          CopyPart(frame_.t.data() + from, n, row.t + to);
        });
        FindRuns(&row);
      }
      EvaluateRadiosity(shades.data(), background, &row);
      count(&FrameTimes::evaluate);
      finish(row);
      count(finishing);
    });
    times *= lap() / std::max(times.Total(), std::numeric_limits<double>::min());
    times.triangle_ids += ids;
  });
  FrameTimes sum;
  for (const FrameTimes& times : tile_times_) sum += times;
  sum *= wall() / std::max(sum.Total(), std::numeric_limits<double>::min());
  frame_.ms += sum;
}

const RenderedFrame& TwoPassDisplay::Render(const Camera& camera, int width, int height, ShadingMode mode) {
  DrawPasses(camera, width, height);
  frame_.linear.Resize(width, height);
  const std::size_t pixels = frame_.linear.PixelCount();
  frame_.triangle.resize(pixels);
  frame_.s.resize(pixels);
  frame_.t.resize(pixels);
  frame_.kind.resize(pixels);

  const bool radiosity = mode == ShadingMode::kRadiosity;
  const TileGrid tiles(width, height);
  DrawTiles(radiosity ? radiosity_ : reflectance_, 0, &FrameTimes::evaluate, [&](const BlockRow& row) {
    ForEachPart(tiles, row.x, row.y, kBlockSize, [&](std::size_t from, std::size_t to, std::size_t n) {
      for (std::size_t c = 0; c < 3; ++c)
        CopyPart(row.rgb[c] + from, n, frame_.linear.channel[c].data() + to);
      for (std::size_t i = 0; i < n; ++i) {
        const std::uint32_t id = row.ids[from + i];
        const PixelKind kind = radiosity && id != kNoTriangle ? kind_[id] : PixelKind::kSurface;
        frame_.kind[to + i] = id == kNoTriangle ? PixelKind::kBackground : kind;
      }
      if (!rasteriser_) return;
      CopyPart(row.ids + from, n, frame_.triangle.data() + to);
      CopyPart(row.s + from, n, frame_.s.data() + to);
      CopyPart(row.t + from, n, frame_.t.data() + to);
    });
  });
  return frame_;
}

const RenderedFrame& TwoPassDisplay::RenderScreen(const Camera& camera, int width, int height,
                                                  ShadingMode mode, const ToneMapping& settings) {
  DrawPasses(camera, width, height);
  frame_.screen.Resize(width, height);
  const ScreenTransfer transfer(static_cast<float>(settings.exposure), kBackground,
                                settings.dither ? DitherOffsets() : nullptr);
  const bool radiosity = mode == ShadingMode::kRadiosity;
  constexpr float kNothing = -1;  // radiosity is never below 0
  DrawTiles(radiosity ? screen_ : reflectance_, kNothing, &FrameTimes::tone_map, [&](BlockRow& row) {
    const int rows = std::min(kBlockSize, height - row.y), columns = std::min(kTileSize, width - row.x);
    const auto bytes = [&](int y) {
      return frame_.screen.pixels.data() + 3 * frame_.screen.Index(row.x, row.y + y);
    };
    // Rows of the picture lie far apart: they are sent for while their codes are computed.
    for (int y = 0; y < rows; ++y)
      for (int at = 0; at < 3 * columns; at += kCacheLine) __builtin_prefetch(bytes(y) + at, 1);
    FillScreen(transfer, &row);
    for (int y = 0; y < rows; ++y) PackScreen(row, y, static_cast<std::size_t>(columns), bytes(y));
  });
  return frame_;
}

const RenderedFrame& TwoPassDisplay::ToneMap(const ToneMapping& settings) {
  Lap lap;
  penumbra::ToneMap(frame_.linear, frame_.kind, settings, &frame_.screen);
  frame_.ms.tone_map = lap();
  return frame_;
}

}  // namespace penumbra
