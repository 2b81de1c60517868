// solver/scene/material_check.h
//
// Checks the materials of files that are not OBJ. (The reader of MTL files does the same line by line.)

#pragma once

#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// Makes the materials that a file gives usable: multiplies emittances by pi if
// SceneOptions::emission_is_radiance says so, and clamps reflectances to SceneOptions::max_reflectance.
// Appends a warning if reflectances were clamped. Throws InputError, which names the material, if a
// reflectance is not in [0, 1) or an emittance is negative or not finite.
void CheckMaterials(std::string_view file, const SceneOptions& options, std::vector<Material>& materials,
                    std::vector<std::string>& warnings);

}  // namespace penumbra
