// solver/scene/mtl_reader.h
//
// Wavefront MTL: `newmtl`, `Kd` (reflectance) and `Ke` (emittance [W/m^2]); everything else is ignored.

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/scene.h"
#include "solver/scene/scene_options.h"

namespace penumbra {

// A material, and the 1-based line of its `newmtl`.
struct DefinedMaterial {
  Material material;
  int line = 0;
};

// The materials of the text, in their order. A material without Kd has the reflectance 0.5 in each channel.
// A `newmtl` without a name defines a material with an empty name, with a warning.
// `file` is the name of the text in messages. Values that were clamped or read in an unusual way add a line
// to `warnings`. Throws InputError.
std::vector<DefinedMaterial> ReadMtlText(std::string_view text, std::string_view file,
                                         const SceneOptions& options, std::vector<std::string>& warnings);

}  // namespace penumbra
