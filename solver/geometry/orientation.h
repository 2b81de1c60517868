// solver/geometry/orientation.h
//
// The exact sign that every decision about points in the plane rests on.

#pragma once

#include "solver/geometry/vec.h"

namespace penumbra {

// +1 if a, b, c turn left, -1 if they turn right, 0 if they lie on a line: exact for the coordinates given.
int Orientation(const Vec2& a, const Vec2& b, const Vec2& c);

}  // namespace penumbra
