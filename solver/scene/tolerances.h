// solver/scene/tolerances.h
//
// The distances within which points, lines and surfaces count as coincident.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// SnapDistance() is the distance on a patch within which two points, or a point and a line, count as one [m].
// Discontinuity lines on a patch are projections of edges through points; for discontinuities that matter,
// the projection has an error of about 1e3 rounding errors of the patch's coordinates. The snap distance
// exceeds the projection error by several orders of magnitude, and is far smaller than the details of
// pictures and interpolants.
// The distance within which points count as one, divided by the diameter of the patch.
inline constexpr double kSnap = 1e-9;
// The value of (snap distance) / (largest coordinate of the patch), about 4e3 times the relative rounding
// error of a double.
inline constexpr double kSnapCoordinate = 1e-12;
double SnapDistance(const Patch& patch);

// ContactGap() is the largest distance between surfaces that are meant to touch [m]. If the coordinates in a
// file are rounded to six decimals, a wall may end half a micrometre above or below its floor. Light that
// passes through the gap between wall and floor would be an artefact.
// The value of (contact gap) / (length of the scene's diagonal), equal to kPlanarTolerance.
inline constexpr double kContactGap = 1e-6;
double ContactGap(const Scene& scene);

}  // namespace penumbra
