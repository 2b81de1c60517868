// solver/visibility/pair/tube.h
//
// The tube of two polygons: their convex hull, outside which nothing can block light between them (Teller and
// Hanrahan 1993).

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/vec.h"
#include "solver/visibility/pair/screens.h"

namespace penumbra {

// Of a height above a plane, relative to the coordinates: what rounding of vertices and normal can make of
// zero. Polygons that see each other only by less than this lie in one plane.
inline constexpr double kCoplanar = 1e-12;

// Two edges whose cross product is this small beside their lengths are parallel but for rounding: they span
// no plane.
inline constexpr double kParallel = 1e-12;

class Tube {
 public:
  // REQUIRES: a and b are convex and planar, and each lies on or before the other's plane.
  Tube(std::span<const Vec3> a, std::span<const Vec3> b);

  // The tube's planes and its bounding box: no point of the tube lies outside.
  ConvexRegion Region() const;

  // True if the convex polygon, whose plane has the unit normal `normal`, does not meet the tube's interior:
  // it then cannot block. Conservative: false may be returned for polygons just outside.
  bool Misses(std::span<const Vec3> polygon, const Vec3& normal) const;

  // True if the convex polygon cuts every segment from a to b, so that it alone hides one from the other.
  bool HiddenBy(std::span<const Vec3> polygon, const Vec3& normal) const;

 private:
  void AddSupportingPlanes(std::span<const Vec3> from, std::span<const Vec3> to);

  std::span<const Vec3> a_, b_;
  Vec3 low_, high_;      // bounding box
  double rounding_ = 0;  // how far a computed height above a plane may be off [m]
  ConvexRegion planes_;
};

}  // namespace penumbra
