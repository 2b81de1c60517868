#include "solver/visibility/point/image_frame.h"

#include <cmath>

#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

// A polygon fits into an image if all its vertices are within acos(0.25) of the axis.
constexpr double kLeastCosine = 0.25;

// The label of the edge of the polygon that contains the edge from a to b of a part of the polygon.
EdgeLabel EdgeAlong(const DirectionPolygon& polygon, const Vec3& a, const Vec3& b) {
  constexpr double kAlong = 1e-12;  // sine of an angle; cutting moves points on an edge by about 1e-16
  for (int k = 0; k < polygon.size(); ++k) {
    const Vec3 m = EdgeNormal(polygon[k], polygon.Next(k)).normalized();
    if (std::abs(m.dot(a)) <= kAlong * a.norm() && std::abs(m.dot(b)) <= kAlong * b.norm())
      return EdgeLabel::OfSource(k);
  }
  return EdgeLabel::Inner();
}

// The square of a shorter length is not a normal number.
constexpr double kLeastLength = 1e-150;

__extension__ typedef __float128 Quadruple;

// (a x b) . c, where a x b is computed as a x (b - a).
template <class Real>
double TripleProduct(const Vec3& a, const Vec3& b, const Vec3& c) {
  const std::array<Real, 3> p = {a.x(), a.y(), a.z()}, q = {b.x() - p[0], b.y() - p[1], b.z() - p[2]};
  return static_cast<double>((p[1] * q[2] - p[2] * q[1]) * c.x() + (p[2] * q[0] - p[0] * q[2]) * c.y() +
                             (p[0] * q[1] - p[1] * q[0]) * c.z());
}

}  // namespace

ImageFrame::ImageFrame(const DirectionPolygon& polygon, const Vec3& axis) : axis_(axis), first_(polygon[0]) {
  const Frame frame = MakeFrame(Vec3::Zero(), axis);
  e1_ = frame.u;
  e2_ = frame.v;
  origin_ = first_ / axis.dot(first_);
  shift_ = Vec2(e1_.dot(origin_), e2_.dot(origin_));
}

ImageLine ImageFrame::Line(const Cone& cone, int k, Digits digits) const {
  const Vec3& normal = cone.normal[static_cast<std::size_t>(k)];
  ImageLine line{normal.dot(e1_), normal.dot(e2_), normal.dot(origin_)};
  if (digits != Digits::kDouble) {
    const Vec3 &a = cone.direction[static_cast<std::size_t>(k)], &b = cone.end[static_cast<std::size_t>(k)];
    const double product = digits == Digits::kExtended ? TripleProduct<long double>(a, b, first_)
                                                       : TripleProduct<Quadruple>(a, b, first_);
    line.h = product / EdgeNormal(a, b).norm() / axis_.dot(first_);
  }
  const double length = std::sqrt(line.a * line.a + line.b * line.b);
  // A plane perpendicular to the axis has no line in the image.
  if (length < kLeastLength) return {0, 0, line.h};
  const double scale = 1 / length;
  return {scale * line.a, scale * line.b, scale * line.h};
}

Vec3 ImageAxis(const DirectionPolygon& polygon) {
  std::array<double, DirectionPolygon::kCapacity> length;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < polygon.size(); ++i) {
    length[i] = polygon[i].norm();
    sum += polygon[i] / length[i];
  }
  const double total = sum.norm();
  if (total == 0) return Vec3::Zero();
  const Vec3 axis = sum / total;
  for (int i = 0; i < polygon.size(); ++i)
    if (axis.dot(polygon[i]) < kLeastCosine * length[i]) return Vec3::Zero();
  return axis;
}

void SplitForImages(const DirectionPolygon& polygon, const Vec3& normal, std::vector<ImagePart>& parts) {
  const Vec3 axis = ImageAxis(polygon);
  if (!axis.isZero(0)) {
    ImagePart& part = parts.emplace_back(ImagePart{polygon, axis, {}});
    for (int i = 0; i < polygon.size(); ++i) part.label[i] = EdgeLabel::OfSource(i);
    return;
  }
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  for (const double right : {1.0, -1.0})
    for (const double up : {1.0, -1.0}) {
      const DirectionPolygon quarter = Above(Above(polygon, right * frame.u), up * frame.v);
      if (quarter.size() < 3) continue;
      ImagePart& part =
          parts.emplace_back(ImagePart{quarter, (right * frame.u + up * frame.v + normal).normalized(), {}});
      for (int i = 0; i < quarter.size(); ++i)
        part.label[i] = EdgeAlong(polygon, quarter[i], quarter.Next(i));
    }
}

}  // namespace penumbra
