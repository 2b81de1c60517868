#include "solver/visibility/pair/tube.h"

#include <algorithm>

#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {
Tube::Tube(std::span<const Vec3> a, std::span<const Vec3> b) : a_(a), b_(b), low_(a[0]), high_(a[0]) {
  for (const std::span<const Vec3> polygon : {a, b})
    for (const Vec3& v : polygon) {
      low_ = low_.cwiseMin(v);
      high_ = high_.cwiseMax(v);
    }
  rounding_ = HeightRounding(std::max(MaxAbs(low_), MaxAbs(high_)));
  planes_.reserve(a.size() + b.size() + 2);
  AddSupportingPlanes(a, b);
  AddSupportingPlanes(b, a);
}

void Tube::AddSupportingPlanes(std::span<const Vec3> from, std::span<const Vec3> to) {
  const auto add_if_supporting = [&](const Vec3& normal, const Vec3& on) {
    double low = 0, high = 0;
    for (const std::span<const Vec3> polygon : {from, to})
      for (const Vec3& v : polygon) {
        const double h = normal.dot(v - on);
        low = std::min(low, h);
        high = std::max(high, h);
      }
    if (high <= rounding_ && low >= -rounding_) return;
    if (low >= -rounding_) planes_.push_back({normal, normal.dot(on)});
    if (high <= rounding_) planes_.push_back({-normal, -normal.dot(on)});
  };
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vec3& p = from[i];
    const Vec3 edge = from[(i + 1) % from.size()] - p;
    for (const Vec3& q : to) {
      const Vec3 normal = edge.cross(q - p);
      const double length = normal.norm();
      if (length > kParallel * edge.norm() * (q - p).norm()) add_if_supporting(normal / length, p);
    }
  }
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 2; i < from.size(); ++i) area += (from[i - 1] - from[0]).cross(from[i] - from[0]);
  if (area.squaredNorm() > 0) add_if_supporting(area.normalized(), from[0]);
}

ConvexRegion Tube::Region() const {
  ConvexRegion region = planes_;
  for (int axis = 0; axis < 3; ++axis) {
    region.push_back({Vec3::Unit(axis), low_[axis]});
    region.push_back({-Vec3::Unit(axis), -high_[axis]});
  }
  return region;
}

bool Tube::Misses(std::span<const Vec3> polygon, const Vec3& normal) const {
  Vec3 low = polygon[0], high = polygon[0];
  for (const Vec3& v : polygon) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  if (((low - high_).array() > 0).any() || ((low_ - high).array() > 0).any()) return true;

  const double tolerance = rounding_ + HeightRounding(std::max(MaxAbs(low), MaxAbs(high)));
  for (const HalfSpace& plane : planes_) {
    bool outside = true;
    for (const Vec3& v : polygon) outside = outside && plane.normal.dot(v) - plane.offset <= tolerance;
    if (outside) return true;
  }
  double lowest = 0, highest = 0;
  for (const std::span<const Vec3> end : {a_, b_})
    for (const Vec3& v : end) {
      const double h = normal.dot(v - polygon[0]);
      lowest = std::min(lowest, h);
      highest = std::max(highest, h);
    }
  return lowest >= -tolerance || highest <= tolerance;
}

bool Tube::HiddenBy(std::span<const Vec3> polygon, const Vec3& normal) const {
  // The points where segments from a to b cross a plane between them are the convex hull of the crossings of
  // segments between vertices.
  const double side = normal.dot(a_[0] - polygon[0]) > 0 ? 1 : -1;
  for (const Vec3& p : a_) {
    const double hp = side * normal.dot(p - polygon[0]);
    if (hp <= rounding_) return false;
    for (const Vec3& q : b_) {
      const double hq = side * normal.dot(q - polygon[0]);
      if (hq >= -rounding_) return false;
      const Vec3 crossing = p + (q - p) * (hp / (hp - hq));
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
        if (normal.cross(edge).dot(crossing - polygon[i]) < 0) return false;
      }
    }
  }
  return true;
}

}  // namespace penumbra
