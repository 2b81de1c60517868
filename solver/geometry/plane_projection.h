// solver/geometry/plane_projection.h
//
// Projection of a plane along the coordinate axis nearest to the plane's normal. The projection copies two
// coordinates of each point without rounding, so that exact two-dimensional predicates of the projections
// hold exactly for the given points.

#pragma once

#include <utility>

#include "solver/geometry/vec.h"

namespace penumbra {

class PlaneProjection {
 public:
  // Makes the projection of the plane through `point` with the normal `normal`, which need not be a unit
  // vector but must not be zero. A polygon that is counter-clockwise about the normal is counter-clockwise in
  // the projection.
  PlaneProjection(const Vec3& point, const Vec3& normal) : point_(point), normal_(normal) {
    normal.cwiseAbs().maxCoeff(&dropped_);
    x_ = (dropped_ + 1) % 3;
    y_ = (dropped_ + 2) % 3;
    if (normal[dropped_] < 0) std::swap(x_, y_);
  }

  Vec2 ToPlane(const Vec3& p) const { return {p[x_], p[y_]}; }

  // Returns the point of the plane in space whose projection is exactly p.
  Vec3 FromPlane(const Vec2& p) const {
    Vec3 lifted;
    lifted[x_] = p.x();
    lifted[y_] = p.y();
    lifted[dropped_] =
        point_[dropped_] -
        (normal_[x_] * (p.x() - point_[x_]) + normal_[y_] * (p.y() - point_[y_])) / normal_[dropped_];
    return lifted;
  }

 private:
  Vec3 point_, normal_;
  int dropped_ = 2, x_ = 0, y_ = 1;
};

}  // namespace penumbra
