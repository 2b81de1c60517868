#include "display/atlas/light_atlas.h"

#include <algorithm>
#include <optional>

#include "display/glm_conversion.h"
#include "display/tone_mapping.h"
#include "mesh/interpolants/mesh_locator.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// The point of the convex patch that is nearest to a point in its plane.
Vec3 NearestOf(const Patch& patch, const Vec3& point) {
  const std::span<const Vec3> corners = patch.Vertices();
  bool inside = true;
  Vec3 nearest = corners[0];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3& from = corners[i];
    const Vec3 edge = corners[(i + 1) % corners.size()] - from;
    inside = inside && patch.normal.cross(edge).dot(point - from) >= 0;
    const double t = std::clamp(edge.dot(point - from) / edge.squaredNorm(), 0.0, 1.0);
    const Vec3 candidate = from + t * edge;
    if ((candidate - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = candidate;
  }
  return inside ? point : nearest;
}

void FillChart(const Scene& scene, const IrradianceMesh& mesh, const MeshLocator& locator, const Chart& chart,
               LightAtlas* atlas) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(chart.patch)];
  for (int y = chart.y; y < chart.y + chart.height; ++y)
    for (int x = chart.x; x < chart.x + chart.width; ++x) {
      const Vec3 point = NearestOf(patch, atlas->layout.PointAt(chart, x + 0.5, y + 0.5));
      const std::optional<MeshLocator::Location> at = locator.Find(chart.patch, point);
      const std::size_t i = atlas->irradiance.Index(x, y);
      atlas->patch[i] = chart.patch;
      if (at) atlas->irradiance.Set(i, ToPixel(IrradianceAt(mesh, *at).max(0.0)));
    }
}

// The exposed picture of emit(patch) * irradiance.
Srgb8Image OnScreen(const LightAtlas& atlas, double exposure, const auto& factor, const auto& emits) {
  RgbImage shown = atlas.irradiance;
  std::vector<PixelKind> kinds(shown.PixelCount(), PixelKind::kSurface);
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (atlas.patch[i] == kNoPatch) continue;
    if (emits(atlas.patch[i])) kinds[i] = PixelKind::kEmitter;
    shown.Set(i, shown.At(i) * ToPixel(factor(atlas.patch[i])));
  }
  Srgb8Image screen;
  EncodeSrgb(Expose(shown, kinds, exposure), false, &screen);
  return screen;
}

}  // namespace

LightAtlas MakeLightAtlas(const Scene& scene, const IrradianceMesh& mesh, int size) {
  LightAtlas atlas;
  atlas.layout = LayOutCharts(scene, size);
  atlas.irradiance.Resize(size, size);
  for (std::vector<float>& plane : atlas.irradiance.channel) std::fill(plane.begin(), plane.end(), 0.0f);
  atlas.patch.assign(atlas.irradiance.PixelCount(), kNoPatch);
  const MeshLocator locator(scene, mesh);
  ParallelFor(atlas.layout.charts.size(), 1,
              [&](std::size_t i) { FillChart(scene, mesh, locator, atlas.layout.charts[i], &atlas); });
  return atlas;
}

Srgb8Image IrradianceOnScreen(const LightAtlas& atlas, double exposure) {
  return OnScreen(
      atlas, exposure, [](PatchId) { return Rgb(Rgb::Ones()); }, [](PatchId) { return false; });
}

Srgb8Image RadiosityOnScreen(const Scene& scene, const LightAtlas& atlas, double exposure) {
  return OnScreen(
      atlas, exposure, [&scene](PatchId patch) { return scene.MaterialOf(patch).reflectance; },
      [&scene](PatchId patch) { return (scene.MaterialOf(patch).emittance > 0).any(); });
}

}  // namespace penumbra
