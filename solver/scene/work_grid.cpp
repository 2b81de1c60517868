#include "solver/scene/work_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr double kNoHeight = -std::numeric_limits<double>::infinity();

// A face looks up if the upward part of its unit normal exceeds this; less is the rounding of a wall.
constexpr double kLeastUpwards = 1e-9;

// Faces look one way if |sum of their vector areas| exceeds this fraction of the sum of their areas. A floor
// has 1, the walls of a room have 0.
constexpr double kMostlyOneWay = 0.9;

// An extent that is short of a whole number of spacings by this fraction of a spacing counts as whole:
// coordinates in files are rounded.
constexpr double kRoundedSpacings = 1e-6;

// The number of points along an extent: one at least.
double PointsAlong(double extent, double spacing) {
  return std::max(1.0, std::floor(extent / spacing + kRoundedSpacings));
}

// The grid without points over a rectangle.
WorkGrid GridOver(const Vec2& low, const Vec2& high, double spacing) {
  const Vec2 extent = high - low;
  const double columns = PointsAlong(extent.x(), spacing), rows = PointsAlong(extent.y(), spacing);
  if (!(columns * rows <= kMostGridPoints))
    throw InputError("the grid has more than 10 million points; give a larger --spacing");
  WorkGrid grid;
  grid.columns = static_cast<int>(columns);
  grid.rows = static_cast<int>(rows);
  grid.spacing = spacing;
  grid.first = low + 0.5 * (extent - spacing * Vec2(columns - 1, rows - 1));
  return grid;
}

Vec2 PlaceOf(const WorkGrid& grid, int column, int row) {
  return grid.first + grid.spacing * Vec2(column, row);
}

// Whether the polygon, seen from above, contains the place; an odd number of its edges then lies to one side.
bool LiesBelow(const Polygon3& polygon, const Vec2& at) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec3 &a = polygon[i], &b = polygon[j];
    if ((a.y() > at.y()) == (b.y() > at.y())) continue;
    if (at.x() < a.x() + (b.x() - a.x()) * ((at.y() - a.y()) / (b.y() - a.y()))) inside = !inside;
  }
  return inside;
}

// Raises the heights of the places above the face to the face.
void RaiseTo(const Polygon3& face, const Vec3& normal, const WorkGrid& grid, std::vector<double>* heights) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& v : face) {
    low = low.cwiseMin(v.head<2>());
    high = high.cwiseMax(v.head<2>());
  }
  const auto step = [&](double x, int axis, int count) {
    return static_cast<int>(std::clamp(std::floor((x - grid.first[axis]) / grid.spacing), -1.0, count - 1.0));
  };
  for (int row = std::max(0, step(low.y(), 1, grid.rows)); row <= step(high.y(), 1, grid.rows); ++row)
    for (int column = std::max(0, step(low.x(), 0, grid.columns)); column <= step(high.x(), 0, grid.columns);
         ++column) {
      const Vec2 at = PlaceOf(grid, column, row);
      if (!LiesBelow(face, at)) continue;
      const Vec2 aside = at - face[0].head<2>();
      const double z = face[0].z() - normal.head<2>().dot(aside) / normal.z();
      double& height = (*heights)[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                                  static_cast<std::size_t>(column)];
      height = std::max(height, z);
    }
}

// The error if no face looks up. A floor that looks along a horizontal axis comes from a file whose vertical
// axis was taken for another.
InputError NothingLooksUp(const Scene& scene, std::span<const std::int32_t> faces) {
  Vec3 sum = Vec3::Zero();
  double area = 0;
  for (const std::int32_t face : faces) {
    const Vec3 vector_area = VectorArea(scene.faces[static_cast<std::size_t>(face)].vertices);
    sum += vector_area;
    area += vector_area.norm();
  }
  int axis = 0;
  sum.cwiseAbs().maxCoeff(&axis);
  std::string why = "nothing of it looks up";
  if (axis < 2 && std::abs(sum[axis]) > kMostlyOneWay * area)
    why += std::string("; it looks along ") + (sum[axis] < 0 ? "-" : "+") + "xy"[axis] +
           ": if that should be up, read the file with another --up x, y or z";
  return InputError(why + "; give another --object, or --plane z=Z");
}

}  // namespace

WorkGrid GridOverFaces(const Scene& scene, std::span<const std::int32_t> faces, double height,
                       double spacing) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  std::vector<std::pair<std::int32_t, Vec3>> upward;  // faces, and their normals
  for (const std::int32_t face : faces) {
    const Polygon3& polygon = scene.faces[static_cast<std::size_t>(face)].vertices;
    const Vec3 normal = VectorArea(polygon).stableNormalized();
    if (!(normal.z() > kLeastUpwards)) continue;
    upward.emplace_back(face, normal);
    for (const Vec3& v : polygon) {
      low = low.cwiseMin(v.head<2>());
      high = high.cwiseMax(v.head<2>());
    }
  }
  if (upward.empty()) throw NothingLooksUp(scene, faces);
  WorkGrid grid = GridOver(low, high, spacing);
  std::vector<double> heights(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                              kNoHeight);
  for (const auto& [face, normal] : upward)
    RaiseTo(scene.faces[static_cast<std::size_t>(face)].vertices, normal, grid, &heights);
  std::size_t i = 0;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column, ++i) {
      const Vec2 at = PlaceOf(grid, column, row);
      if (heights[i] > kNoHeight) grid.points.push_back({column, row, {at.x(), at.y(), heights[i] + height}});
    }
  return grid;
}

WorkGrid GridAtHeight(const Scene& scene, double z, double spacing) {
  if (scene.patches.empty()) throw InputError("the scene is empty, and has no extent");
  const auto [low, high] = scene.Bounds();
  WorkGrid grid = GridOver(low.head<2>(), high.head<2>(), spacing);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const Vec2 at = PlaceOf(grid, column, row);
      grid.points.push_back({column, row, {at.x(), at.y(), z}});
    }
  return grid;
}

}  // namespace penumbra
