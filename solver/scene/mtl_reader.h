// solver/scene/mtl_reader.h
//
// Reads Wavefront MTL files: the statements `newmtl`, `Kd` (reflectance) and `Ke` (emittance [W/m^2]); all
// other statements are ignored.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// A material, and the line number, counted from 1, of the `newmtl` statement that defines the material.
struct DefinedMaterial {
  Material material;
  int line = 0;
};

// Returns the materials that the MTL text defines, in the order of the text. A material without Kd has the
// reflectance 0.5 in each channel. A `newmtl` statement without a name defines a material with an empty name,
// and adds a warning. `file` is the name of the MTL file in messages. For values that were clamped or read in
// an unusual way, a line is added to `warnings`. Throws InputError if the text is not valid.
std::vector<DefinedMaterial> ReadMtlText(std::string_view text, std::string_view file,
                                         const SceneOptions& options, std::vector<std::string>& warnings);

}  // namespace penumbra
