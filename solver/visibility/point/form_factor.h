// solver/visibility/point/form_factor.h
//
// The form factor of a point to a polygon that it sees: the irradiance at the point divided by the polygon's
// radiosity. Equal to the fraction of the diffuse light leaving the point's surface that reaches the polygon.

#pragma once

#include <span>

#include "solver/geometry/vec.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// If the sum of the edges' angles exceeds this constant times the edge sum, Gauss quadrature, which adds
// positive terms only, replaces the edge sum.
inline constexpr double kFormFactorCancellation = 200;

// Bound of the relative error of a form factor, if the given vertices, point and normal are taken as exact. A
// term of the edge sum has an error of about 2 roundings (1.1e-16) of its angle, and the angles are at most
// 200 times the sum. The error of 8 x 8 Gauss nodes is smaller.
inline constexpr double kFormFactorError = 1e-13;

// (1 / 2 pi) sum gamma n . m / |m| over the edges a -> b of the polygon, where m = a x b, and gamma is the
// angle between a and b, computed by atan2 (Baum, Rushmeier and Winget 1989; thesis eq. 6.1). Uses quadrature
// if the angles exceed `cancellation` times the sum. REQUIRES: the polygon lies above the horizon of
// `normal`, a unit vector.
double FormFactor(const DirectionPolygon& polygon, const Vec3& normal,
                  double cancellation = kFormFactorCancellation);

// The form factor to the polygon with the vertices base + offset[i]. Edges are differences of the offsets, so
// that small or distant polygons lose no digits.
double FormFactor(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The form factor to the polygon with the vertices base + offset[i] by adaptive Gauss quadrature: slower,
// without cancellation.
double FormFactorByQuadrature(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The contribution of one edge of the visible region to the gradient of the form factor by the position of
// the point, with the normal fixed [1/m]. The edge runs from direction `from` to direction `to`; the visible
// region lies on its left. The edge is the image of the line through `a` and `b`, relative to the point: an
// edge of the source or of a blocker. If the point moves by d, the image moves sideways by d . m / distance
// (the boundary form of Arvo, The irradiance Jacobian for partially occluded polyhedral sources, 1994). Zero
// if the line passes through the point, where no gradient exists.
Vec3 EdgeGradient(const Vec3& a, const Vec3& b, const Vec3& from, const Vec3& to, const Vec3& normal);

// The gradient of the form factor to an unoccluded polygon by the position of the point [1/m].
Vec3 FormFactorGradient(const DirectionPolygon& polygon, const Vec3& normal);

}  // namespace penumbra
