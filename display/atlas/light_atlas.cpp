#include "display/atlas/light_atlas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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

// The point of a triangle, as weights of its corners, that is nearest to a place on the picture.
struct NearestPlace {
  std::array<double, 3> weight{};
  double distance = 0;  // [pixels]; below 0 inside: minus the distance from the nearest edge
};

// REQUIRES: the triangle has an area. `of` are the places of the corners, in either order.
NearestPlace NearestIn(const std::array<Vec2, 3>& of, const Vec2& place) {
  const double area = Cross2(of[1] - of[0], of[2] - of[0]);
  NearestPlace nearest;
  nearest.distance = -std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = of[(k + 1) % 3], &b = of[(k + 2) % 3];
    nearest.weight[k] = Cross2(a - place, b - place) / area;
    inside = inside && nearest.weight[k] >= 0;
    const double height = std::abs(area) / (b - a).norm();
    nearest.distance = std::max(nearest.distance, -nearest.weight[k] * height);
  }
  if (inside) return nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = of[k], along = of[(k + 1) % 3] - a;
    const double t = std::clamp(along.dot(place - a) / along.squaredNorm(), 0.0, 1.0);
    const double distance = (a + t * along - place).norm();
    if (distance >= nearest.distance) continue;
    nearest = {{}, distance};
    nearest.weight[k] = 1 - t;
    nearest.weight[(k + 1) % 3] = t;
  }
  return nearest;
}

// The faces of a scene, drawn on the picture of an atlas by their texture coordinates.
class FacePainter {
 public:
  FacePainter(const Scene& scene, const LightAtlas& atlas)
      : scene_(scene),
        atlas_(atlas),
        size_(atlas.irradiance.width),
        distance_(atlas.irradiance.PixelCount(), kChartPadding),
        face_(distance_.size(), -1),
        point_(distance_.size()),
        patches_of_face_(scene.faces.size()) {
    for (std::size_t p = 0; p < scene.patches.size(); ++p)
      for (const std::int32_t face : scene.patches[p].faces)
        patches_of_face_[static_cast<std::size_t>(face)].push_back(static_cast<PatchId>(p));
  }

  void Draw(std::int32_t face) {
    const AtlasPolygon& polygon = atlas_.polygons[static_cast<std::size_t>(face)];
    for (const std::array<std::int32_t, 3>& triangle : polygon.triangles) {
      std::array<Vec2, 3> places;
      for (std::size_t k = 0; k < 3; ++k) places[k] = polygon.places[static_cast<std::size_t>(triangle[k])];
      if (std::abs(Cross2(places[1] - places[0], places[2] - places[0])) < kNoArea) continue;
      DrawTriangle(face, triangle, places);
    }
  }

  // The patch of the face at the pixel that is nearest to the pixel's point, and its point nearest to it;
  // kNoPatch if no face is there, or no patch of the face.
  std::pair<PatchId, Vec3> PlaceOf(std::size_t pixel) const {
    std::pair<PatchId, Vec3> place{kNoPatch, Vec3::Zero()};
    if (face_[pixel] < 0) return place;
    double nearest = std::numeric_limits<double>::infinity();
    for (const PatchId id : patches_of_face_[static_cast<std::size_t>(face_[pixel])]) {
      const Vec3 point = NearestOf(scene_.patches[static_cast<std::size_t>(id)], point_[pixel]);
      const double distance = (point - point_[pixel]).norm();
      if (distance < nearest) place = {id, point};
      nearest = std::min(nearest, distance);
    }
    return place;
  }

 private:
  static constexpr double kNoArea = 1e-6;  // twice the area of a triangle that covers no pixel [pixels]
  // Two faces overlap if the centre of a pixel lies within both, farther from the edges than this [pixels].
  static constexpr double kOverlap = 0.5;

  void DrawTriangle(std::int32_t face, const std::array<std::int32_t, 3>& triangle,
                    const std::array<Vec2, 3>& places) {
    const Vec2 low = places[0].cwiseMin(places[1]).cwiseMin(places[2]),
               high = places[0].cwiseMax(places[1]).cwiseMax(places[2]);
    const auto pixel = [this](double at) {
      return std::clamp(static_cast<int>(std::floor(at)), 0, size_ - 1);
    };
    for (int y = pixel(low.y() - kChartPadding); y <= pixel(high.y() + kChartPadding); ++y)
      for (int x = pixel(low.x() - kChartPadding); x <= pixel(high.x() + kChartPadding); ++x) {
        const NearestPlace nearest = NearestIn(places, {x + 0.5, y + 0.5});
        const std::size_t i = atlas_.irradiance.Index(x, y);
        if (nearest.distance < -kOverlap && distance_[i] < -kOverlap && face_[i] != face)
          throw InputError(fmt::format(
              "{}: error: faces {} and {} (counted from 0) overlap in the texture coordinates; unwrap the "
              "scene without overlaps, or give --uv own",
              scene_.name, face_[i], face));
        if (nearest.distance >= distance_[i]) continue;
        distance_[i] = nearest.distance;
        face_[i] = face;
        point_[i] = Vec3::Zero();
        const Polygon3& corners = atlas_.polygons[static_cast<std::size_t>(face)].corners;
        for (std::size_t k = 0; k < 3; ++k)
          point_[i] += nearest.weight[k] * corners[static_cast<std::size_t>(triangle[k])];
      }
  }

  const Scene& scene_;
  const LightAtlas& atlas_;
  int size_;
  std::vector<double> distance_;    // from the face of each pixel, as NearestPlace::distance
  std::vector<std::int32_t> face_;  // the face of each pixel; -1 for none
  std::vector<Vec3> point_;         // the point of the face [m]
  std::vector<std::vector<PatchId>> patches_of_face_;
};

void FillFaces(const Scene& scene, const IrradianceMesh& mesh, const MeshLocator& locator,
               LightAtlas* atlas) {
  FacePainter painter(scene, *atlas);
  for (std::size_t f = 0; f < atlas->polygons.size(); ++f) painter.Draw(static_cast<std::int32_t>(f));
  constexpr std::size_t kPixelsATask = 4096;
  ParallelFor(atlas->patch.size(), kPixelsATask, [&](std::size_t i) {
    const auto [patch, point] = painter.PlaceOf(i);
    if (patch == kNoPatch) return;
    atlas->patch[i] = patch;
    const std::optional<MeshLocator::Location> at = locator.Find(patch, point);
    if (at) atlas->irradiance.Set(i, ToPixel(IrradianceAt(mesh, *at).max(0.0)));
  });
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

LightAtlas MakeLightAtlas(const Scene& scene, const IrradianceMesh& mesh, int size, AtlasPlaces places) {
  LightAtlas atlas;
  atlas.irradiance.Resize(size, size);
  for (std::vector<float>& plane : atlas.irradiance.channel) std::fill(plane.begin(), plane.end(), 0.0f);
  atlas.patch.assign(atlas.irradiance.PixelCount(), kNoPatch);
  const MeshLocator locator(scene, mesh);
  if (places == AtlasPlaces::kScene) {
    atlas.polygons = PolygonsOfFaces(scene, size);
    FillFaces(scene, mesh, locator, &atlas);
    return atlas;
  }
  atlas.layout = LayOutCharts(scene, size);
  atlas.polygons = PolygonsOfPatches(scene, atlas.layout);
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
