#include "solver/scene/material_check.h"

#include <numbers>

#include "solver/scene/scene_assembler.h"
#include "solver/scene/text_reader.h"

namespace penumbra {

void CheckMaterials(std::string_view file, const SceneOptions& options, std::vector<Material>& materials,
                    std::vector<std::string>& warnings) {
  int clamped = 0;
  for (Material& material : materials) {
    const std::string name = Quoted(material.name);
    if (options.emission_is_radiance) material.emittance *= std::numbers::pi;
    if (!(material.emittance >= 0).all() || !(material.emittance <= kLargestEmittance).all())
      throw ErrorAt(file, 0,
                    "the emission of the material " + name +
                        " is negative, too large or not a number; give a value of 0 or more");
    if (options.max_reflectance && (material.reflectance > *options.max_reflectance).any()) {
      material.reflectance = material.reflectance.min(*options.max_reflectance);
      ++clamped;
    }
    if (!(material.reflectance >= 0).all() || !(material.reflectance < 1).all())
      throw ErrorAt(file, 0,
                    "the reflectance of the material " + name +
                        " is not in [0, 1); change it in the file, or clamp it with --max-reflectance 0.9");
  }
  if (clamped > 0)
    warnings.push_back(
        WarningAt(file, 0, Plural(clamped, "reflectance") + " clamped to the greatest allowed"));
}

}  // namespace penumbra
