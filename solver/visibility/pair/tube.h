// solver/visibility/pair/tube.h
//
// The tube of two polygons is their convex hull: nothing outside the tube can block light between the
// polygons (Teller and Hanrahan 1993).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/visibility/pair/screens.h"

namespace penumbra {

// For a point that lies in a plane, |computed height above the plane| / (largest coordinate) is at most
// kCoplanar, because of the rounding errors of vertices and normal. Polygons whose heights above each other's
// planes are at most kCoplanar * (largest coordinate) count as coplanar.
inline constexpr double kCoplanar = 1e-12;

// If |u x v| <= kParallel * |u| * |v|, the edges u and v count as parallel and span no plane.
inline constexpr double kParallel = 1e-12;

class Tube {
 public:
  // REQUIRES: the polygons `a` and `b` are convex and planar, each lies on or in front of the other's plane,
  // and both outlive the tube.
  Tube(std::span<const Vec3> a, std::span<const Vec3> b);

  // A convex region that contains the tube, bounded by planes of the tube and by its bounding box.
  ConvexRegion Region() const;

  // True if the convex polygon `polygon` does not meet the tube's interior and so cannot block light;
  // `normal` is the unit normal of the polygon's plane. The test is conservative: Misses() may return false
  // for a polygon just outside the tube.
  bool Misses(std::span<const Vec3> polygon, const Vec3& normal) const;

  // True if the convex polygon `polygon` cuts every segment between the ends of the tube, so that this
  // polygon alone hides one end from the other.
  bool HiddenBy(std::span<const Vec3> polygon, const Vec3& normal) const;

 private:
  void AddSupportingPlanes(std::span<const Vec3> from, std::span<const Vec3> to);

  std::span<const Vec3> a_, b_;
  Vec3 low_, high_;      // the minimum and the maximum corner of the tube's bounding box [m]
  double rounding_ = 0;  // an upper bound of the rounding error of a height above a plane [m]
  ConvexRegion planes_;
};

}  // namespace penumbra
