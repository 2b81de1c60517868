#include "solver/visibility/point/direction_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

// Bound of the error of a height n . (x - p), relative to the coordinates: rounding of input, difference,
// normal and sum.
constexpr double kHeightError = 16 * std::numeric_limits<double>::epsilon();

// An approach at less than this angle to a plane [rad] runs within the plane. Coplanar polygons of tilted
// planes differ by rounding only, and a triangle never approaches a contact edge at so small an angle.
constexpr double kParallelApproach = 1e-10;

// An arc shorter than this [rad] is one vertex with rounding errors. Cones leave it out.
constexpr double kNoArc = 1e-13;

// For an arc shorter than this [rad], rounding may turn the great circle by up to 1e-9, so the side on which
// the cone lies is uncertain.
constexpr double kShortArc = 1e-6;

bool IsArcShorter(const Vec3& a, const Vec3& b, const Vec3& normal, double angle) {
  return normal.squaredNorm() <= angle * angle * a.squaredNorm() * b.squaredNorm();
}

// The ends of an edge are nearly opposite if sin^2 of the angle between them is below this.
constexpr double kOpposite = 0.01;

using Heights = std::array<double, DirectionPolygon::kCapacity>;

// The part of the polygon above a plane, from the heights of its vertices. `crossing` computes the direction
// where an edge meets the plane, from the edge's ends and their heights, of which one is positive and one
// negative.
template <class Crossing>
DirectionPolygon PartAbove(const DirectionPolygon& polygon, const Heights& height, const Crossing& crossing) {
  bool any_above = false, any_below = false;
  for (int i = 0; i < polygon.size(); ++i) {
    any_above |= height[static_cast<std::size_t>(i)] > 0;
    any_below |= height[static_cast<std::size_t>(i)] < 0;
  }
  if (!any_below) return polygon;
  DirectionPolygon above;
  if (!any_above) return above;
  for (int i = 0; i < polygon.size(); ++i) {
    const int j = i + 1 == polygon.size() ? 0 : i + 1;
    const double ha = height[static_cast<std::size_t>(i)], hb = height[static_cast<std::size_t>(j)];
    if (ha >= 0) above.Add(polygon[i]);
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0)) above.Add(crossing(polygon[i], polygon[j], ha, hb));
  }
  return above;
}

const auto kBetween = [](const Vec3& a, const Vec3& b, double ha, double hb) -> Vec3 {
  return (std::abs(hb) * a + std::abs(ha) * b) / (std::abs(ha) + std::abs(hb));
};

// Bound of the rounding error of the height of v above a plane of the cone.
double HeightRoundingOf(const Cone& cone, const Vec3& v) {
  return cone.rounding + kHeightError * v.cwiseAbs().sum();
}

// If the triple product of a plane and an edge's ends, relative to their lengths, is below this, the edge
// passes close to the point or crosses the plane at a small angle. Rounding then turns n x (a x b) by more
// than 1e-10.
constexpr double kFlat = 1e-6;

// The direction in which the edge from a to b meets a plane through the point: n x m, with m = a x b. For
// small angles (kFlat), n x m may have the wrong sign; the direction is then interpolated from the heights of
// the ends, with more digits. Otherwise the sign follows from the heights: if a is above, the great circle of
// the edge, which turns about m, descends through the plane opposite to n x m.
struct CrossingOf {
  const Vec3& plane;

  Vec3 operator()(const Vec3& a, const Vec3& b, double ha, double hb) const {
    const Vec3 c = plane.cross(EdgeNormal(a, b));
    if (c.squaredNorm() < kFlat * kFlat * a.squaredNorm() * b.squaredNorm()) return Between(a, b);
    const double scale = std::abs(ha) + std::abs(hb);
    return c / (ha > 0 ? -scale : scale);
  }

 private:
  Vec3 Between(const Vec3& a, const Vec3& b) const {
    using Long = Eigen::Matrix<long double, 3, 1>;
    const Long n = plane.cast<long double>(), p = a.cast<long double>(), q = b.cast<long double>();
    const long double hp = std::abs(n.dot(p)), hq = std::abs(n.dot(q));
    return ((hq * p + hp * q) / (hp + hq)).cast<double>();
  }
};

// True if the viewpoint lies on the segment from a to b (relative to it), within `tolerance`.
bool OnEdge(const Vec3& a, const Vec3& b, double tolerance) {
  const Vec3 edge = b - a;
  return a.dot(b) < 0 && EdgeNormal(a, b).squaredNorm() <= tolerance * tolerance * edge.squaredNorm();
}

double Rounding(const ReceiverPoint& at, double extent) {
  return at.uncertainty + HeightRounding(MaxAbs(at.position) + extent);
}

struct Levelled {
  DirectionPolygon polygon;
  Heights height;
};

// Sets the heights of vertices within rounding of the receiver's plane to exactly zero: a remaining rounding
// error could cut an edge at an arbitrary place.
Levelled Level(const DirectionPolygon& seen, const Vec3& normal, double rounding) {
  Levelled level;
  for (int i = 0; i < seen.size(); ++i) {
    const double height = normal.dot(seen[i]);
    const bool in_plane = std::abs(height) <= rounding;
    level.polygon.Add(in_plane ? Vec3(seen[i] - height * normal) : seen[i]);
    level.height[static_cast<std::size_t>(i)] = in_plane ? 0 : height;
  }
  return level;
}

}  // namespace

Vec3 EdgeNormal(const Vec3& a, const Vec3& b) {
  const double aa = a.squaredNorm(), bb = b.squaredNorm();
  const bool a_first =
      aa < bb || (aa == bb && std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3));
  const Vec3 m = a_first ? Vec3(a.cross(b - a)) : Vec3(-b.cross(a - b));
  // If the point is close to the middle of the edge, rounding turns the plane noticeably; long double avoids
  // this.
  if (m.squaredNorm() >= kOpposite * aa * bb || a.dot(b) >= 0) return m;
  return a.cast<long double>().cross(b.cast<long double>()).cast<double>();
}

double HeightRounding(double extent) { return kHeightError * extent; }

Side SideOf(const ReceiverPoint& at, const Vec3& normal, const Vec3& on, double extent) {
  const double height = normal.dot(at.position - on), rounding = Rounding(at, extent);
  if (height > rounding) return Side::kFront;
  if (height < -rounding) return Side::kBack;
  const double rise = normal.dot(at.approach), least = kParallelApproach * at.approach.norm();
  if (rise > least) return Side::kFrontInLimit;
  if (rise < -least) return Side::kBackInLimit;
  return Side::kInPlane;
}

DirectionPolygon Seen(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front) {
  // Counter-clockwise about a normal that points to x is clockwise about the direction of sight.
  DirectionPolygon seen;
  const auto n = static_cast<int>(polygon.size());
  for (int i = 0; i < n; ++i)
    seen.Add(polygon[static_cast<std::size_t>(from_front ? n - 1 - i : i)] - at.position);
  return seen;
}

DirectionPolygon SeenInContact(const ReceiverPoint& at, std::span<const Vec3> polygon, bool from_front) {
  double extent = 0;
  for (const Vec3& v : polygon) extent = std::max(extent, MaxAbs(v));
  const double rounding = Rounding(at, extent);

  const Levelled seen = Level(Seen(at, polygon, from_front), at.normal, rounding);
  const DirectionPolygon above = PartAbove(seen.polygon, seen.height, kBetween);

  DirectionPolygon limit;
  bool touches = false;
  const Vec3 away = -at.approach.normalized();
  const auto at_point = [&](const Vec3& v) { return v.squaredNorm() <= rounding * rounding; };
  for (int i = 0; i < above.size(); ++i) {
    const Vec3 &a = above[i], &b = above.Next(i);
    if (at_point(a)) {
      touches = true;
      limit.Add(away);
      continue;
    }
    limit.Add(a);
    if (!at_point(b) && OnEdge(a, b, rounding)) {
      touches = true;
      limit.Add(away);
    }
  }
  if (!touches) limit.clear();
  return limit;
}

DirectionPolygon ClipToHorizon(const ReceiverPoint& at, const DirectionPolygon& polygon, double extent) {
  const Levelled seen = Level(polygon, at.normal, Rounding(at, extent));
  return PartAbove(seen.polygon, seen.height, CrossingOf{at.normal});
}

Cone MakeCone(const ReceiverPoint& at, const DirectionPolygon& blocker, double extent) {
  Cone cone;
  for (int i = 0; i < blocker.size(); ++i) {
    const Vec3 m = EdgeNormal(blocker[i], blocker.Next(i));
    if (IsArcShorter(blocker[i], blocker.Next(i), m, kNoArc) && blocker[i].dot(blocker.Next(i)) >= 0)
      continue;
    const double length = m.norm();
    if (length == 0) continue;
    PENUMBRA_CHECK(cone.size < static_cast<int>(cone.normal.size()));
    cone.normal[static_cast<std::size_t>(cone.size)] = m / length;
    cone.direction[static_cast<std::size_t>(cone.size)] = blocker[i];
    cone.end[static_cast<std::size_t>(cone.size)] = blocker.Next(i);
    ++cone.size;
  }
  if (cone.size < 3) cone.size = 0;
  cone.rounding = Rounding(at, extent);
  return cone;
}

Overlap Classify(const Cone& cone, const DirectionPolygon& polygon) {
  if (cone.size == 0) return Overlap::kNone;
  Heights rounding;
  for (int i = 0; i < polygon.size(); ++i)
    rounding[static_cast<std::size_t>(i)] = HeightRoundingOf(cone, polygon[i]);
  int cutting = 0;
  for (int k = 0; k < cone.size; ++k) {
    const Vec3& m = cone.normal[static_cast<std::size_t>(k)];
    bool any_inside = false, any_outside = false;
    for (int i = 0; i < polygon.size() && !(any_inside && any_outside); ++i) {
      const double h = m.dot(polygon[i]), zero = rounding[static_cast<std::size_t>(i)];
      any_inside = any_inside || h > zero;
      any_outside = any_outside || h < -zero;
    }
    if (!any_inside) return Overlap::kNone;
    cutting += any_outside ? 1 : 0;
  }
  if (cutting == 0) return Overlap::kAll;
  // The polygon crosses one plane and lies inside all others, so the cone covers a part of the polygon.
  if (cutting == 1) return Overlap::kPart;
  for (int i = 0; i < polygon.size(); ++i) {
    const Vec3 m = EdgeNormal(polygon[i], polygon.Next(i));
    if (IsArcShorter(polygon[i], polygon.Next(i), m, kShortArc)) continue;
    bool any_inside = false;
    for (int k = 0; k < cone.size && !any_inside; ++k)
      any_inside = m.dot(cone.direction[static_cast<std::size_t>(k)]) > 0;
    if (!any_inside) return Overlap::kNone;
  }
  return Overlap::kPart;
}

DirectionPolygon Above(const DirectionPolygon& polygon, const Vec3& plane) {
  Heights height;
  for (int i = 0; i < polygon.size(); ++i) height[static_cast<std::size_t>(i)] = plane.dot(polygon[i]);
  return PartAbove(polygon, height, CrossingOf{plane});
}

}  // namespace penumbra
