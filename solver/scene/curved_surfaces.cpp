#include "solver/scene/curved_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace penumbra {
namespace {

// Pieces of a circle: the least multiple of four, which keeps what is symmetric symmetric, that satisfies
// kCurveTolerance.
int Pieces() {
  static const int pieces = [] {
    int n = 4;
    while (1 - std::cos(std::numbers::pi / n) > kCurveTolerance) n += 4;
    return n;
  }();
  return pieces;
}

// The point i of the circle of n points around an axis, as a direction across the axis.
class CircleDirections {
 public:
  explicit CircleDirections(const Vec3& axis) {
    // Across the axis that is farthest from parallel; the same for an axis and its opposite.
    int least = 0;
    for (int k = 1; k < 3; ++k)
      if (std::abs(axis[k]) < std::abs(axis[least])) least = k;
    const Vec3 unit = axis.normalized();
    u_ = unit.cross(Vec3::Unit(least)).normalized();
    v_ = unit.cross(u_);
  }
  Vec3 At(int i) const {
    const int n = Pieces();
    // From the first quarter, so that opposite points are exactly opposite.
    const int quarter = (i % n) / (n / 4), rest = (i % n) % (n / 4);
    const double angle = 2 * std::numbers::pi * rest / n, c = rest == 0 ? 1 : std::cos(angle),
                 s = rest == 0 ? 0 : std::sin(angle);
    if (quarter == 0) return c * u_ + s * v_;
    if (quarter == 1) return c * v_ - s * u_;
    if (quarter == 2) return -c * u_ - s * v_;
    return s * u_ - c * v_;
  }

 private:
  Vec3 u_, v_;
};

// A point of a surface of revolution: its place along the axis and its distance from it.
struct ProfilePoint {
  double along = 0, radius = 0;
};

// The surface that a profile makes as it turns around the axis. The outside is to the right of the profile,
// for one who looks with the axis up and the profile to the right of it.
std::vector<Polygon3> TurnedProfile(const Vec3& origin, const Vec3& axis,
                                    const std::vector<ProfilePoint>& profile) {
  const CircleDirections circle(axis);
  const Vec3 unit = axis.normalized();
  const auto corner = [&](const ProfilePoint& p, int i) -> Vec3 {
    return p.radius == 0 ? Vec3(origin + p.along * unit)
                         : Vec3(origin + p.along * unit + p.radius * circle.At(i));
  };
  std::vector<Polygon3> polygons;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k)
    for (int i = 0; i < Pieces(); ++i) {
      const ProfilePoint &low = profile[k], &high = profile[k + 1];
      Polygon3 polygon = {corner(low, i)};
      if (low.radius > 0) polygon.push_back(corner(low, i + 1));
      polygon.push_back(corner(high, i + 1));
      if (high.radius > 0) polygon.push_back(corner(high, i));
      if (polygon.size() >= 3) polygons.push_back(std::move(polygon));
    }
  return polygons;
}

}  // namespace

std::vector<Polygon3> SpherePolygons(const Vec3& centre, double radius) {
  const int half = Pieces() / 2;
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= half; ++i) {
    const double angle = std::numbers::pi * (i - 0.5 * half) / half;
    const bool pole = i == 0 || i == half;
    profile.push_back({radius * std::sin(angle), pole ? 0 : radius * std::cos(angle)});
  }
  return TurnedProfile(centre, Vec3::UnitZ(), profile);
}

std::vector<Polygon3> ConePolygons(const Vec3& from, double from_radius, const Vec3& to, double to_radius) {
  const double length = (to - from).norm();
  return TurnedProfile(from, to - from, {{0, from_radius}, {length, to_radius}});
}

std::vector<Polygon3> RingPolygons(const Vec3& centre, const Vec3& normal, double inner, double outer) {
  // Its profile runs inwards, so that its right is up. A disk is one polygon.
  if (inner > 0) return TurnedProfile(centre, normal, {{0, outer}, {0, inner}});
  const CircleDirections circle(normal);
  Polygon3 disk;
  for (int i = 0; i < Pieces(); ++i) disk.push_back(centre + outer * circle.At(i));
  return {disk};
}

std::vector<Polygon3> TorusPolygons(const Vec3& centre, const Vec3& axis, double major, double minor) {
  const int pieces = Pieces();
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= pieces; ++i) {
    const double angle = 2 * std::numbers::pi * (i % pieces) / pieces;
    profile.push_back({minor * std::sin(angle), major + minor * std::cos(angle)});
  }
  return TurnedProfile(centre, axis, profile);
}

std::vector<Polygon3> Reversed(std::vector<Polygon3> polygons) {
  for (Polygon3& polygon : polygons) std::reverse(polygon.begin(), polygon.end());
  return polygons;
}

}  // namespace penumbra
