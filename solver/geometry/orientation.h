// solver/geometry/orientation.h
//
// The exact orientation predicate, on which all decisions about points in the plane are based.

#pragma once

#include "solver/geometry/vec.h"

namespace penumbra {

// Returns +1 if the points a, b, c make a left turn, -1 if they make a right turn, 0 if they lie on a line.
// The returned orientation is exact for the given coordinates.
int Orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace penumbra
