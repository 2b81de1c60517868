// mesh/discontinuities/discontinuity_line.h
//
// Lines on a patch, and the intervals of the lines that discontinuities cover.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The part of a line from parameter t0 to t1 [m].
struct LineInterval {
  double t0 = 0, t1 = 0;
};

// A straight line with a direction.
struct DirectedLine {
  Vec2 origin = Vec2::Zero(), direction = Vec2::UnitX();  // unit direction

  double Along(const Vec2& p) const { return direction.dot(p - origin); }
  // The signed distance from the line [m], positive to its left.
  double Distance(const Vec2& p) const { return Cross2(direction, p - origin); }
  Vec2 At(double t) const { return origin + t * direction; }
};

// Collinear active discontinuities, in the frame of their patch [m].
struct DiscontinuityLine : DirectedLine {
  std::vector<LineInterval> cover;    // covered by any discontinuity: ascending, disjoint
  std::vector<LineInterval> contact;  // covered by a contact (D0): ascending, disjoint
};

// True if the distance of t from one of the intervals is at most `reach` [m].
bool Covers(std::span<const LineInterval> intervals, double t, double reach);

// The part of the line inside the convex counter-clockwise outline and at least `inset` [m] from each side of
// the outline. A negative inset extends the outline. The interval is empty if t0 > t1.
LineInterval ClipLine(const Vec2& origin, const Vec2& direction, const Polygon2& outline, double inset);

}  // namespace penumbra
