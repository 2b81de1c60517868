// solver/scene/geometry_difference.h
//
// Whether two scenes differ in nothing but their materials, so that what was found of one's geometry, form
// factors and visibility, holds for the other.

#pragma once

#include <optional>
#include <string>

#include "solver/scene/scene.h"

namespace penumbra {

// What the first difference is, in words that follow "the scenes differ: "; nothing if all faces and all
// patches are the same to the bit. Names, materials and objects may differ.
std::optional<std::string> GeometryDifference(const Scene& one, const Scene& other);

}  // namespace penumbra
