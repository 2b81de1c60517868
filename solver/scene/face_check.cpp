#include "solver/scene/face_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/geometry/constrained_triangulation.h"
#include "solver/geometry/orientation.h"
#include "solver/geometry/plane_projection.h"

namespace penumbra {
namespace {

// The two vertices farthest apart, and the one farthest from the line through them.
struct Extent {
  Vec3 a, b, c;
  double diameter = 0, width = 0;
};

Extent FindExtent(const Polygon3& face) {
  Extent extent;
  for (std::size_t i = 0; i < face.size(); ++i)
    for (std::size_t j = i + 1; j < face.size(); ++j)
      if (const double d = (face[i] - face[j]).norm(); d > extent.diameter) {
        extent.diameter = d;
        extent.a = face[i];
        extent.b = face[j];
      }
  if (extent.diameter == 0) return extent;
  const Vec3 along = (extent.b - extent.a) / extent.diameter;
  for (const Vec3& p : face)
    if (const double w = along.cross(p - extent.a).norm(); w > extent.width) {
      extent.width = w;
      extent.c = p;
    }
  return extent;
}

bool IsConvexQuadrilateral(const std::vector<Vec2>& p) {
  for (int i = 0; i < 4; ++i)
    if (Orientation(p[i], p[(i + 1) % 4], p[(i + 2) % 4]) <= 0) return false;
  return true;
}

// In the plane: whether the outline winds around every point once or not at all, and around some point once.
FaceCondition CheckOutline(const std::vector<Vec2>& outline) {
  if (outline.size() == 4 && IsConvexQuadrilateral(outline)) return FaceCondition::kFine;
  std::vector<ConstraintSegment> border;
  const auto size = static_cast<std::int32_t>(outline.size());
  for (std::int32_t i = 0; i < size; ++i) border.push_back({i, (i + 1) % size, kBorder});
  ConstrainedTriangulator triangulator;
  bool inside = false;
  const ConstrainedTriangulation* mesh = triangulator.TryTriangulate(outline, border);
  if (!mesh) return FaceCondition::kSelfCrossing;  // an outline that is simple beside rounding has a mesh
  for (const ConstrainedTriangulation::Triangle& triangle : mesh->triangles) {
    if (triangle.winding < 0 || triangle.winding > 1) return FaceCondition::kSelfCrossing;
    inside = inside || triangle.winding == 1;
  }
  return inside ? FaceCondition::kFine : FaceCondition::kZeroArea;
}

}  // namespace

int RemoveRepeatedVertices(Polygon3& face) {
  const std::size_t before = face.size();
  for (bool changed = true; changed && face.size() >= 2;) {
    changed = false;
    for (std::size_t i = 0; i < face.size() && face.size() >= 2; ++i) {
      const std::size_t next = (i + 1) % face.size(), after = (i + 2) % face.size();
      const bool repeated = face[i] == face[next];
      const bool spike = face.size() >= 3 && face[i] == face[after];
      if (!repeated && !spike) continue;
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(next));
      changed = true;
    }
  }
  return static_cast<int>(before - face.size());
}

FaceCondition CheckFace(const Polygon3& face) {
  if (face.size() < 3) return FaceCondition::kZeroArea;
  const Extent extent = FindExtent(face);
  double largest = 0;
  for (const Vec3& p : face) largest = std::max(largest, MaxAbs(p));
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * largest;
  if (extent.width <= std::max(kZeroWidth * extent.diameter, rounding)) return FaceCondition::kZeroArea;
  // The area of a face too small for its square to be a double counts as none.
  const bool has_area = VectorArea(face).norm() > 0;
  if (face.size() == 3) return has_area ? FaceCondition::kFine : FaceCondition::kZeroArea;

  // A self-crossing face can have no area to take the normal from.
  constexpr double kLittleArea = 1e-6;
  Vec3 normal = VectorArea(face);
  if (normal.norm() < kLittleArea * extent.diameter * extent.width)
    normal = (extent.b - extent.a).cross(extent.c - extent.a);
  normal.normalize();
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : face) mean += (p - face[0]) / static_cast<double>(face.size());
  mean += face[0];
  for (const Vec3& p : face)
    if (std::abs(normal.dot(p - mean)) > kPlanarTolerance * extent.diameter) return FaceCondition::kNotPlanar;

  const PlaneProjection projection(mean, normal);
  std::vector<Vec2> outline;
  for (const Vec3& p : face) outline.push_back(projection.ToPlane(p));
  const FaceCondition condition = CheckOutline(outline);
  return condition == FaceCondition::kFine && !has_area ? FaceCondition::kZeroArea : condition;
}

}  // namespace penumbra
