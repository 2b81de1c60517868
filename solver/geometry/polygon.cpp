#include "solver/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// A triangle whose sides make an angle of this sine or less loses three digits or more in their cross
// product.
constexpr double kThin = 1e-3;

// Twice the vector area of the triangle. That of a thin one is as good as its two shorter sides are: from two
// long ones its normal would be turned by their rounding over its width, along its length too.
Vec3 TwiceTriangle(const Vec3& p, const Vec3& q, const Vec3& r) {
  const Vec3 a = q - p, b = r - p, area = a.cross(b);
  const double aa = a.squaredNorm(), bb = b.squaredNorm();
  if (area.squaredNorm() > kThin * kThin * aa * bb) return area;
  const Vec3 c = r - q;
  const double longest = std::max({aa, bb, c.squaredNorm()});
  return aa == longest ? b.cross(c) : bb == longest ? a.cross(c) : area;
}

}  // namespace

Vec3 VectorArea(std::span<const Vec3> polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += TwiceTriangle(polygon[0], polygon[i - 1], polygon[i]);
  return 0.5 * sum;
}

Vec3 Centroid(std::span<const Vec3> polygon) {
  PENUMBRA_CHECK(!polygon.empty());
  const Vec3 normal = VectorArea(polygon);
  Vec3 moment = Vec3::Zero();
  double weight = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    const double w = a.cross(b).dot(normal);
    moment += w * (a + b) / 3.0;
    weight += w;
  }
  if (weight > 0) return polygon[0] + moment / weight;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : polygon) mean += v / static_cast<double>(polygon.size());
  return mean;
}

namespace {

// Below this, comparing all pairs takes no longer than looking along the directions.
constexpr std::size_t kAllPairs = 512;

// The pair farthest apart of `count` points, point(i) each, all compared with all.
template <class PointOf>
std::pair<std::size_t, std::size_t> FarthestOfAll(std::size_t count, const PointOf& point) {
  std::pair<std::size_t, std::size_t> farthest{0, 0};
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      if (const double d = (point(i) - point(j)).squaredNorm(); d > largest) {
        largest = d;
        farthest = {i, j};
      }
  return farthest;
}

// The outermost points along directions spread over a half sphere, ascending.
std::vector<std::size_t> OutermostPoints(std::span<const Vec3> polygon) {
  constexpr int kDirections = 256;  // no direction is farther than 0.1 from one of them: 0.5 % of a length
  constexpr double kGoldenAngle = 2 * std::numbers::pi * (2 - std::numbers::phi);
  std::vector<std::size_t> outermost;
  for (int k = 0; k < kDirections; ++k) {
    const double z = (k + 0.5) / kDirections, r = std::sqrt(1 - z * z);
    const Vec3 direction(r * std::cos(k * kGoldenAngle), r * std::sin(k * kGoldenAngle), z);
    std::size_t low = 0, high = 0;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const double height = direction.dot(polygon[i] - polygon[0]);
      if (height < lowest) {
        lowest = height;
        low = i;
      }
      if (height > highest) {
        highest = height;
        high = i;
      }
    }
    outermost.push_back(low);
    outermost.push_back(high);
  }
  std::sort(outermost.begin(), outermost.end());
  outermost.erase(std::unique(outermost.begin(), outermost.end()), outermost.end());
  return outermost;
}

}  // namespace

std::pair<std::size_t, std::size_t> FarthestPair(std::span<const Vec3> polygon) {
  if (polygon.size() <= kAllPairs)
    return FarthestOfAll(polygon.size(), [&](std::size_t i) -> const Vec3& { return polygon[i]; });
  const std::vector<std::size_t> outermost = OutermostPoints(polygon);
  const auto [a, b] =
      FarthestOfAll(outermost.size(), [&](std::size_t i) -> const Vec3& { return polygon[outermost[i]]; });
  return {outermost[a], outermost[b]};
}

double Diameter(std::span<const Vec3> polygon) {
  if (polygon.empty()) return 0;
  const auto [a, b] = FarthestPair(polygon);
  return std::sqrt((polygon[a] - polygon[b]).squaredNorm());
}

double SignedArea(std::span<const Vec2> polygon) {
  double sum = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += Cross2(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * sum;
}

Frame MakeFrame(const Vec3& origin, const Vec3& normal) {
  // The axis least aligned with the normal gives the best conditioned tangent.
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  const Vec3 u = Vec3::Unit(axis).cross(normal).normalized();
  return {origin, u, normal.cross(u), normal};
}

Frame PolygonFrame(std::span<const Vec3> polygon) {
  const Vec3 area = VectorArea(polygon);
  PENUMBRA_CHECK(area.squaredNorm() > 0);
  const Vec3 normal = area.normalized();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    edge -= edge.dot(normal) * normal;
    if (edge.squaredNorm() == 0) continue;
    const Vec3 u = edge.normalized();
    return {polygon[0], u, normal.cross(u), normal};
  }
  return MakeFrame(polygon[0], normal);
}

Polygon3 ClipToHalfSpace(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& point,
                         double tolerance) {
  const auto height = [&](const Vec3& p) {
    const double h = normal.dot(p - point);
    return std::abs(h) <= tolerance ? 0 : h;
  };
  Polygon3 kept;
  kept.reserve(polygon.size() + 1);
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3& a = polygon[i];
    const Vec3& b = polygon[(i + 1) % polygon.size()];
    const double ha = height(a), hb = height(b);
    if (ha >= 0) kept.push_back(a);
    if (ha > 0) inside = true;
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) kept.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  if (!inside || kept.size() < 3) kept.clear();
  return kept;
}

bool ConvexContains(std::span<const Vec3> polygon, const Vec3& normal, const Vec3& p, double tolerance) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (normal.cross(edge).dot(p - polygon[i]) < -tolerance * edge.norm()) return false;
  }
  return true;
}

}  // namespace penumbra
