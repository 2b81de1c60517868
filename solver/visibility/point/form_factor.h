// solver/visibility/point/form_factor.h
//
// The form factor of a point to a polygon that it sees: the fraction of what the point's surface would send
// out that meets the polygon; times the polygon's radiosity, the irradiance that comes from it.

#pragma once

#include <span>

#include "solver/geometry/vec.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// The sum over the edges is used unless their angles add up to more than this many times its value. Beyond
// that the integral is done by Gauss quadrature, which adds up positive terms only.
inline constexpr double kFormFactorCancellation = 200;

// Largest error of a form factor, relative to its value, for exactly the vertices, point and normal given: a
// term of the sum is off by some 2 roundings of 1.1e-16 of its angle, and the angles are 200 times the sum; 8
// x 8 Gauss nodes are off by less.
inline constexpr double kFormFactorError = 1e-13;

// (1 / 2 pi) sum gamma n . m / |m| over the edges a -> b of the polygon, m = a x b, gamma the angle between a
// and b by atan2 (Baum, Rushmeier and Winget 1989; thesis eq. 6.1). The polygon must lie above the horizon
// of `normal` (unit). Quadrature takes over where the angles are more than `cancellation` times the sum.
double FormFactor(const DirectionPolygon& polygon, const Vec3& normal,
                  double cancellation = kFormFactorCancellation);

// The same for the polygon with the vertices base + offset[i], which keeps the digits of a polygon that is
// small or far: its edges are differences of the offsets.
double FormFactor(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The same by adaptive Gauss quadrature: slower, without cancellation.
double FormFactorByQuadrature(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The share of one edge of what is visible in the gradient of the form factor by the position of the point,
// normal fixed [1/m]. The edge runs between the directions `from` and `to`, with what is visible on its left;
// it is the image of the line through `a` and `b` (as seen from the point), be it an edge of the source or of
// a blocker: as the point moves by d, the image moves across by d . m / distance (the boundary form of Arvo,
// The irradiance Jacobian for partially occluded polyhedral sources, 1994). Zero where the line passes
// through the point: there is no gradient.
Vec3 EdgeGradient(const Vec3& a, const Vec3& b, const Vec3& from, const Vec3& to, const Vec3& normal);

// The gradient of the form factor to a polygon, all of whose edges are edges in space.
Vec3 FormFactorGradient(const DirectionPolygon& polygon, const Vec3& normal);

}  // namespace penumbra
