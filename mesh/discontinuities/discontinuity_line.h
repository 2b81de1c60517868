// mesh/discontinuities/discontinuity_line.h
//
// Lines of a patch, and where on them discontinuities lie.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// A part of a line, from t0 to t1 along it [m].
struct LineInterval {
  double t0 = 0, t1 = 0;
};

// A straight line with a sense.
struct DirectedLine {
  Vec2 origin = Vec2::Zero(), direction = Vec2::UnitX();  // direction is unit

  double Along(const Vec2& p) const { return direction.dot(p - origin); }
  // Positive to the left of the line [m].
  double Distance(const Vec2& p) const { return Cross2(direction, p - origin); }
  Vec2 At(double t) const { return origin + t * direction; }
};

// Collinear active discontinuities, in the frame of their patch.
struct DiscontinuityLine : DirectedLine {
  std::vector<LineInterval> cover;    // where any of them lies: ascending, disjoint
  std::vector<LineInterval> contact;  // where a contact (D0) lies: ascending, disjoint
};

// True if t lies in one of the intervals or within `reach` of it.
bool Covers(std::span<const LineInterval> intervals, double t, double reach);

// The part of the line inside the convex counter-clockwise outline and at least `inset` [m] from each of its
// sides (beyond them, for a negative inset). Empty if t0 > t1.
LineInterval ClipLine(const Vec2& origin, const Vec2& direction, const Polygon2& outline, double inset);

}  // namespace penumbra
