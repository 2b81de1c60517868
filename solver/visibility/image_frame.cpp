#include "solver/visibility/image_frame.h"

#include <cmath>

#include "solver/geometry/polygon.h"

namespace penumbra {
namespace {

// A polygon fits into an image if all its vertices are within acos(0.25) of the axis.
constexpr double kLeastCosine = 0.25;

// The edge of the polygon that the edge from a to b of a part of it runs along.
std::int32_t EdgeAlong(const DirectionPolygon& polygon, const Vec3& a, const Vec3& b) {
  constexpr double kAlong = 1e-12;
  for (int k = 0; k < polygon.size(); ++k) {
    const Vec3 m = EdgeNormal(polygon[k], polygon.Next(k)).normalized();
    if (std::abs(m.dot(a)) <= kAlong * a.norm() && std::abs(m.dot(b)) <= kAlong * b.norm()) return k;
  }
  return kInnerEdge;
}

using LongVec3 = Eigen::Matrix<long double, 3, 1>;

}  // namespace

ImageFrame::ImageFrame(const DirectionPolygon& polygon, const Vec3& axis) : axis_(axis), first_(polygon[0]) {
  const Frame frame = MakeFrame(Vec3::Zero(), axis);
  e1_ = frame.u;
  e2_ = frame.v;
  origin_ = first_ / axis.dot(first_);
  shift_ = Vec2(e1_.dot(origin_), e2_.dot(origin_));
}

ImageLine ImageFrame::Line(const Cone& cone, int k, bool fine) const {
  const Vec3& normal = cone.normal[static_cast<std::size_t>(k)];
  ImageLine line{normal.dot(e1_), normal.dot(e2_), normal.dot(origin_)};
  if (fine) {
    const LongVec3 a = cone.direction[static_cast<std::size_t>(k)].cast<long double>(),
                   b = cone.end[static_cast<std::size_t>(k)].cast<long double>();
    const LongVec3 m = a.cross(b - a);
    line.h = static_cast<double>(m.dot(first_.cast<long double>()) / m.norm()) / axis_.dot(first_);
  }
  const double length = std::sqrt(line.a * line.a + line.b * line.b);
  // The plane of directions beside the axis has no line in the image.
  if (length < 1e-150) return {0, 0, line.h};
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
    for (int i = 0; i < polygon.size(); ++i) part.label[i] = i;
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
