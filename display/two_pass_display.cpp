#include "display/two_pass_display.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

constexpr std::size_t kRowsPerTask = 8;

// Calls `phase` and returns the milliseconds it took.
template <class Phase>
double Milliseconds(const Phase& phase) {
  const auto start = std::chrono::steady_clock::now();
  phase();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

Rasteriser MakeRasteriser(const IrradianceMesh& mesh) {
  std::vector<Rasteriser::VertexIndices> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const IrradianceMesh::Triangle& triangle : mesh.triangles) triangles.push_back(triangle.vertex);
  return {mesh.positions, std::move(triangles)};
}

void Store(const Rgb& rgb, float* out) {
  for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(rgb[c]);
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

TwoPassDisplay::TwoPassDisplay(const Scene& scene, const IrradianceMesh& mesh)
    : rasteriser_(MakeRasteriser(mesh)) {
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
}

const RenderedFrame& TwoPassDisplay::Render(const Camera& camera, int width, int height, ShadingMode mode) {
  const PixelRays rays = MakePixelRays(camera, width, height);
  frame_.width = width;
  frame_.height = height;
  frame_.linear.Resize(width, height);
  const std::size_t pixels = frame_.linear.PixelCount();
  frame_.triangle.resize(pixels);
  frame_.s.resize(pixels);
  frame_.t.resize(pixels);
  frame_.kind.resize(pixels);

  frame_.ms = {};
  frame_.ms.triangle_ids =
      Milliseconds([&] { rasteriser_.DrawTriangleIds(rays, width, height, frame_.triangle); });
  frame_.ms.barycentric =
      Milliseconds([&] { rasteriser_.DrawBarycentrics(frame_.triangle, frame_.s, frame_.t); });
  frame_.ms.evaluate =
      Milliseconds([&] { Evaluate(mode == ShadingMode::kRadiosity ? radiosity_ : reflectance_, mode); });
  return frame_;
}

void TwoPassDisplay::Evaluate(const std::vector<TriangleShade>& shades, ShadingMode mode) {
  const auto width = static_cast<std::size_t>(frame_.width);
  const std::span<const std::uint32_t> ids = frame_.triangle;
  ParallelFor(static_cast<std::size_t>(frame_.height), kRowsPerTask, [&](std::size_t y) {
    ForEachRun(ids.subspan(y * width, width), kTileSize, [&](int x, int n, std::uint32_t id) {
      const std::size_t at = y * width + static_cast<std::size_t>(x);
      PixelKind kind = PixelKind::kBackground;
      if (id != kNoTriangle) kind = mode == ShadingMode::kRadiosity ? kind_[id] : PixelKind::kSurface;
      std::fill_n(frame_.kind.data() + at, n, kind);
      for (int c = 0; c < 3; ++c) {
        float* out = frame_.linear.channel[static_cast<std::size_t>(c)].data() + at;
        if (id == kNoTriangle)
          std::fill_n(out, n, 0.0f);
        else
          EvaluateRadiosity(shades[id], c, frame_.s.data() + at, frame_.t.data() + at, n, out);
      }
    });
  });
}

const RenderedFrame& TwoPassDisplay::ToneMap(const ToneMapping& settings) {
  frame_.ms.tone_map =
      Milliseconds([&] { penumbra::ToneMap(frame_.linear, frame_.kind, settings, &frame_.screen); });
  return frame_;
}

}  // namespace penumbra
