// solver/scene/geometry_difference.h
//
// Compares the geometry of two scenes. Scenes of equal geometry have the same form factors and visibility,
// even if their materials differ.

#pragma once

#include <optional>
#include <string>

#include "solver/scene/scene.h"

namespace penumbra {

// Describes the first difference in geometry, as a phrase that follows "the scenes differ: "; nullopt if all
// faces and all patches are equal to the bit. Names, materials and objects are not compared.
std::optional<std::string> GeometryDifference(const Scene& one, const Scene& other);

}  // namespace penumbra
