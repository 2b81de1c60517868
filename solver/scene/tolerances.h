// solver/scene/tolerances.h
//
// The distances within which points, lines and surfaces count as the same.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// SnapDistance() is the distance on a patch within which two points, or a point and a line, count as one [m].
// Projecting an edge through a point has an error of about 1e3 roundings of the patch's coordinates for
// discontinuities of relevant weight. The snap distance is several decimal digits larger, and far smaller
// than a picture or an interpolant resolves.
inline constexpr double kSnap = 1e-9;             // relative to the patch's diameter
inline constexpr double kSnapCoordinate = 1e-12;  // relative to the patch's largest coordinate: 4e3 roundings
double SnapDistance(const Patch& patch);

// ContactGap() is the largest distance between things that are meant to touch [m]. Files with six decimals
// leave half a micrometre between a wall and its floor, or let the wall sink into the floor. Light through
// such a gap is an artefact.
inline constexpr double kContactGap =
    1e-6;  // relative to the scene's diagonal; the same number as kPlanarTolerance
double ContactGap(const Scene& scene);

}  // namespace penumbra
