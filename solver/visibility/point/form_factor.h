// solver/visibility/point/form_factor.h
//
// The form factor of a point to a polygon that it sees: the irradiance at the point divided by the polygon's
// radiosity. The form factor is also the fraction of the diffuse light from the surface at the point that
// reaches the polygon.

#pragma once

#include <span>

#include "solver/geometry/vec.h"
#include "solver/visibility/point/direction_polygon.h"

namespace penumbra {

// The form factor of a polygon is a sum over its edges. If (sum of the edges' angles) >
// kFormFactorCancellation * (edge sum), Gauss quadrature, which adds only positive terms, replaces the edge
// sum.
inline constexpr double kFormFactorCancellation = 200;

// A bound of the relative error of a form factor, if the given vertices, point and normal are taken as exact.
// Each term of the edge sum has a relative error of about 2 * 1.1e-16, and the sum of the edges' angles is at
// most 200 times the edge sum. The error of quadrature with 8 x 8 Gauss nodes is smaller than
// kFormFactorError.
inline constexpr double kFormFactorError = 1e-13;

// The form factor as the edge sum (1 / 2 pi) sum gamma n . m / |m| over the edges a -> b of the polygon
// (Baum, Rushmeier and Winget 1989; thesis eq. 6.1), where n is `normal`, m = a x b, and gamma is the angle
// between a and b, computed by atan2. Quadrature replaces the edge sum if (sum of the angles gamma)
// > `cancellation` * (edge sum). REQUIRES: the polygon lies above the horizon of `normal`, a unit vector.
double FormFactor(const DirectionPolygon& polygon, const Vec3& normal,
                  double cancellation = kFormFactorCancellation);

// The form factor of the point at the origin to the polygon with the vertices base + offset[i]. Edges are
// computed as differences of the offsets, so that small or distant polygons lose no digits.
double FormFactor(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The form factor of the point at the origin to the polygon with the vertices base + offset[i], by adaptive
// Gauss quadrature, which is slower than the edge sum but has no cancellation.
double FormFactorByQuadrature(const Vec3& base, std::span<const Vec3> offset, const Vec3& normal);

// The contribution of one edge of the visible region to the gradient of the form factor with respect to the
// position of the point, with the normal fixed [1/m]. The edge runs from direction `from` to direction `to`;
// the visible region lies to the left of the edge. The edge is the image of a line in space, which contains
// an edge of the source or of a blocker; `a` and `b` are two points of this line, relative to the receiver
// point. If the receiver point moves by d, the image of the edge moves sideways by d . m / (distance of the
// line), where m is the unit normal of the plane through the point and the line. EdgeGradient() uses the
// boundary form of Arvo (The irradiance Jacobian for partially occluded polyhedral sources, 1994). The
// contribution of an edge is zero if its line passes through the receiver point, where no gradient exists.
Vec3 EdgeGradient(const Vec3& a, const Vec3& b, const Vec3& from, const Vec3& to, const Vec3& normal);

// The gradient of the form factor to an unoccluded polygon with respect to the position of the point [1/m].
Vec3 FormFactorGradient(const DirectionPolygon& polygon, const Vec3& normal);

}  // namespace penumbra
