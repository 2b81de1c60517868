#include "solver/geometry/planar_sets.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace penumbra {

void Subtract(const Polygon3& from, std::span<const Vec3> hole, const Vec3& normal, double crack,
              std::vector<Polygon3>& left) {
  Polygon3 inside = from;
  for (std::size_t i = 0; i < hole.size() && !inside.empty(); ++i) {
    const Vec3 outwards = (hole[(i + 1) % hole.size()] - hole[i]).cross(normal).normalized();
    Polygon3 outside = ClipToHalfSpace(inside, outwards, hole[i], crack);
    if (!outside.empty() && VectorArea(outside).norm() > crack * Diameter(outside))
      left.push_back(std::move(outside));
    inside = ClipToHalfSpace(inside, -outwards, hole[i], crack);
  }
}

Polygon3 Intersect(Polygon3 polygon, std::span<const Vec3> with, const Vec3& normal, double margin) {
  for (std::size_t i = 0; i < with.size() && !polygon.empty(); ++i) {
    const Vec3 outwards = (with[(i + 1) % with.size()] - with[i]).cross(normal).normalized();
    polygon = ClipToHalfSpace(polygon, -outwards, with[i] + margin * outwards);
  }
  return polygon;
}

Polygon3 ConvexHull(std::span<const Vec3> points, const Vec3& normal) {
  if (points.size() < 3) return {};
  struct Point {
    double x, y;
    std::size_t index;
  };
  const Frame frame = MakeFrame(points[0], normal);
  std::vector<Point> flat;
  flat.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = frame.ToPlane(points[i]);
    flat.push_back({p.x(), p.y(), i});
  }
  std::sort(flat.begin(), flat.end(),
            [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  // Andrew's chains: the lower from left to right, the upper back.
  std::vector<Point> hull;
  hull.reserve(flat.size() + 1);
  const auto add = [&](const Point& next, std::size_t first) {
    while (hull.size() >= first + 2) {
      const Point &a = hull[hull.size() - 2], &b = hull.back();
      if ((b.x - a.x) * (next.y - a.y) - (b.y - a.y) * (next.x - a.x) > 0) break;
      hull.pop_back();
    }
    hull.push_back(next);
  };
  for (const Point& point : flat) add(point, 0);
  const std::size_t turn = hull.size() - 1;
  for (std::size_t i = flat.size() - 1; i-- > 0;) add(flat[i], turn);
  hull.pop_back();
  if (hull.size() < 3) return {};
  Polygon3 polygon;
  polygon.reserve(hull.size());
  for (const Point& point : hull) polygon.push_back(points[point.index]);
  return polygon;
}

}  // namespace penumbra
