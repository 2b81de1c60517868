#include "solver/geometry/convex_clip.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

// To the right of the edge from a to b; zero for an edge without length.
Vec2 Outwards(const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length = along.norm();
  return length > 0 ? Vec2(along.y() / length, -along.x() / length) : Vec2(0, 0);
}

}  // namespace

Polygon2 ClipToHalfPlane(std::span<const Vec2> polygon, const Vec2& outwards, const Vec2& point,
                         double tolerance) {
  const auto depth = [&](const Vec2& p) {
    const double d = -outwards.dot(p - point);
    return std::abs(d) <= tolerance ? 0 : d;
  };
  Polygon2 kept;
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = depth(a), db = depth(b);
    if (da >= 0) kept.push_back(a);
    inside = inside || da > 0;
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  if (!inside || kept.size() < 3) kept.clear();
  return kept;
}

Polygon2 IntersectConvex(Polygon2 polygon, std::span<const Vec2> with) {
  for (std::size_t i = 0; i < with.size() && !polygon.empty(); ++i) {
    const Vec2 outwards = Outwards(with[i], with[(i + 1) % with.size()]);
    if (outwards.squaredNorm() > 0) polygon = ClipToHalfPlane(polygon, outwards, with[i]);
  }
  return polygon;
}

void SubtractConvex(const Polygon2& polygon, std::span<const Vec2> hole, double crack,
                    std::vector<Polygon2>& left) {
  Polygon2 inside = polygon;
  for (std::size_t i = 0; i < hole.size() && !inside.empty(); ++i) {
    const Vec2 outwards = Outwards(hole[i], hole[(i + 1) % hole.size()]);
    if (outwards.squaredNorm() == 0) continue;
    Polygon2 outside = ClipToHalfPlane(inside, -outwards, hole[i], crack);
    if (NarrowestStrip(outside).width > crack) left.push_back(std::move(outside));
    inside = ClipToHalfPlane(inside, outwards, hole[i], crack);
  }
}

Strip NarrowestStrip(std::span<const Vec2> polygon) {
  Strip strip;
  if (polygon.size() < 3) return strip;
  strip.width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 outwards = Outwards(polygon[i], polygon[(i + 1) % polygon.size()]);
    if (outwards.squaredNorm() == 0) continue;
    // The extent to both sides: an edge as short as a rounding error may have any direction, also inwards.
    double lowest = 0, highest = 0;
    for (const Vec2& p : polygon) {
      const double height = outwards.dot(p - polygon[i]);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    if (highest - lowest < strip.width) strip = {highest - lowest, outwards};
  }
  if (!(strip.width < std::numeric_limits<double>::infinity())) strip.width = 0;
  return strip;
}

}  // namespace penumbra
