#include "display/atlas/texture_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/check.h"
#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/plane_projection.h"

namespace penumbra {
namespace {

// Texture coordinates that are rounded to six digits may exceed the picture by this much.
constexpr double kBeyondPicture = 1e-6;

std::vector<Vec2> OnPicture(const Face& face, int size) {
  std::vector<Vec2> places;
  for (const Vec2& uv : face.uv) places.emplace_back(uv.x() * size, (1 - uv.y()) * size);
  return places;
}

// The triangles of a simple polygon, which need not be convex.
std::vector<std::array<std::int32_t, 3>> TrianglesOf(const Polygon3& polygon,
                                                     ConstrainedTriangulator* triangulator) {
  const PlaneProjection plane(polygon[0], VectorArea(polygon));
  std::vector<Vec2> points;
  std::vector<ConstraintSegment> border;
  const auto count = static_cast<std::int32_t>(polygon.size());
  for (std::int32_t i = 0; i < count; ++i) {
    points.push_back(plane.ToPlane(polygon[static_cast<std::size_t>(i)]));
    border.push_back({i, (i + 1) % count, kBorder});
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  const ConstrainedTriangulation* const mesh = triangulator->TryTriangulate(points, border);
  if (!mesh) return triangles;
  for (const ConstrainedTriangulation::Triangle& triangle : mesh->triangles)
    if (triangle.Inside() && std::all_of(triangle.vertex.begin(), triangle.vertex.end(),
                                         [&](std::int32_t v) { return v < count; }))
      triangles.push_back(triangle.vertex);
  return triangles;
}

bool IsOnPicture(const Vec2& uv) {
  return (uv.array() >= -kBeyondPicture).all() && (uv.array() <= 1 + kBeyondPicture).all();
}

// With --two-sided, backs follow the faces and have no place of their own.
std::size_t FacesWithoutBacks(const Scene& scene) {
  const std::size_t half = scene.faces.size() / 2;
  if (scene.faces.size() % 2 != 0 || half == 0) return scene.faces.size();
  for (std::size_t i = 0; i < half; ++i) {
    const Polygon3 &front = scene.faces[i].vertices, &back = scene.faces[half + i].vertices;
    if (!scene.faces[half + i].uv.empty() ||
        !std::equal(front.begin(), front.end(), back.rbegin(), back.rend()))
      return scene.faces.size();
  }
  return half;
}

}  // namespace

std::vector<AtlasPolygon> PolygonsOfPatches(const Scene& scene, const ChartLayout& layout) {
  std::vector<AtlasPolygon> polygons;
  for (const Chart& chart : layout.charts) {
    const std::span<const Vec3> corners = scene.patches[static_cast<std::size_t>(chart.patch)].Vertices();
    AtlasPolygon& polygon = polygons.emplace_back();
    polygon.corners.assign(corners.begin(), corners.end());
    for (const Vec3& corner : corners) polygon.places.push_back(layout.PixelOf(chart, corner));
    for (std::int32_t k = 1; k + 1 < static_cast<std::int32_t>(corners.size()); ++k)
      polygon.triangles.push_back({0, k, k + 1});
  }
  return polygons;
}

std::vector<AtlasPolygon> PolygonsOfFaces(const Scene& scene, int size) {
  constexpr const char* kOwn = "unwrap the scene in its modelling program, or give --uv own";
  ConstrainedTriangulator triangulator;
  std::vector<AtlasPolygon> polygons(scene.faces.size());
  for (std::size_t f = 0; f < FacesWithoutBacks(scene); ++f) {
    const Face& face = scene.faces[f];
    if (face.vertices.empty()) continue;
    if (face.uv.empty())
      throw InputError(fmt::format("{}: error: face {} (counted from 0) has no texture coordinates; {}",
                                   scene.name, f, kOwn));
    if (!std::all_of(face.uv.begin(), face.uv.end(), IsOnPicture))
      throw InputError(fmt::format(
          "{}: error: face {} (counted from 0) has texture coordinates outside of 0 to 1, as tiles have; {}",
          scene.name, f, kOwn));
    polygons[f] = {face.vertices, OnPicture(face, size), TrianglesOf(face.vertices, &triangulator)};
  }
  return polygons;
}

}  // namespace penumbra
