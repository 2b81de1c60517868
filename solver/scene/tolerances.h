// solver/scene/tolerances.h
//
// How near is the same place.

#pragma once

#include "solver/scene/scene.h"

namespace penumbra {

// Distances on a patch below which two points, or a point and a line, count as one [m]. Projecting an edge
// through a point costs some 1e3 roundings of the patch's coordinates where the weight is not negligible; the
// tolerance keeps several digits away from that, and lies far below what a picture or an interpolant
// resolves.
inline constexpr double kSnap = 1e-9;             // of the patch's diameter
inline constexpr double kSnapCoordinate = 1e-12;  // of its largest coordinate: 4e3 roundings
double SnapDistance(const Patch& patch);

// How far apart things may be that are meant to touch [m]: files with six decimals leave half a micrometre
// between a wall and the floor that it stands on, or sink it in. Light through such a gap is an accident.
inline constexpr double kContactGap = 1e-6;  // of the scene's diagonal, as for the planarity of faces
double ContactGap(const Scene& scene);

}  // namespace penumbra
