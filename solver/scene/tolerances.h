// solver/scene/tolerances.h
//
// The distances within which points, lines and surfaces count as the same.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// SnapDistance() is the distance on a patch within which two points, or a point and a line, count as one [m].
// For discontinuities of relevant weight, projecting an edge through a point onto the patch has an error of
// about 1e3 rounding errors of the patch's coordinates. The snap distance exceeds the projection error by
// several orders of magnitude, and is far smaller than the details of pictures and interpolants.
inline constexpr double kSnap = 1e-9;             // relative to the patch's diameter
inline constexpr double kSnapCoordinate = 1e-12;  // relative to the patch's largest coordinate: 4e3 roundings
double SnapDistance(const Patch& patch);

// ContactGap() is the largest distance between things that are meant to touch [m]. If the coordinates in a
// file are rounded to six decimals, a wall may end half a micrometre above or below its floor. Light that
// passes through the gap between wall and floor would be an artefact.
inline constexpr double kContactGap =
    1e-6;  // relative to the scene's diagonal; the same number as kPlanarTolerance
double ContactGap(const Scene& scene);

}  // namespace penumbra
