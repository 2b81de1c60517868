// mesh/discontinuities/discontinuity_line.h
//
// Lines on a patch, and the intervals of these lines that discontinuities cover.

#pragma once

#include <span>
#include <vector>

#include "solver/geometry/polygon.h"

namespace penumbra {

// The part of a line from parameter t0 to parameter t1 [m].
struct LineInterval {
  double t0 = 0, t1 = 0;
};

// A straight line with a direction.
struct DirectedLine {
  // The unit vector `direction` gives the line's direction.
  Vec2 origin = Vec2::Zero(), direction = Vec2::UnitX();

  double Along(const Vec2& p) const { return direction.dot(p - origin); }
  // The signed distance of p from the line [m], positive to the left of the line.
  double Distance(const Vec2& p) const { return Cross2(direction, p - origin); }
  Vec2 At(double t) const { return origin + t * direction; }
};

// A line of active discontinuities (edges of the mesh) that are collinear, in the frame of their patch [m].
struct DiscontinuityLine : DirectedLine {
  // The intervals of the line on which discontinuities lie, ascending and disjoint.
  std::vector<LineInterval> cover;
  // The intervals of the line on which contacts with other surfaces (D0) lie, ascending and disjoint.
  std::vector<LineInterval> contact;
};

// True if the parameter t is within `reach` [m] of one of the intervals.
bool Covers(std::span<const LineInterval> intervals, double t, double reach);

// Returns the part of the line inside the convex counter-clockwise outline and at least `inset` [m] from each
// side of the outline. A negative `inset` enlarges the outline by which the line is clipped. If no part of
// the line is inside, the returned interval has t0 > t1.
LineInterval ClipLine(const Vec2& origin, const Vec2& direction, const Polygon2& outline, double inset);

}  // namespace penumbra
