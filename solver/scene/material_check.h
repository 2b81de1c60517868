// solver/scene/material_check.h
//
// Checks the materials of scene files other than OBJ files. (The reader of MTL files makes the same checks
// for each line.)

#pragma once

#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// Multiplies the emittances of the materials by pi if SceneOptions::emission_is_radiance is true, and clamps
// reflectances to SceneOptions::max_reflectance. Appends a warning if reflectances were clamped. Throws
// InputError, whose message names the material, if a reflectance is not in [0, 1) or an emittance is negative
// or not finite.
void CheckMaterials(std::string_view file, const SceneOptions& options, std::vector<Material>& materials,
                    std::vector<std::string>& warnings);

}  // namespace penumbra
