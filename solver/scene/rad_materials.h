// solver/scene/rad_materials.h
//
// Converts the materials of Radiance scenes to diffuse materials, the only kind that the solver knows.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/rad_text.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct RadMaterial {
  Material material;         // Material::emittance holds a radiance [W/(m^2 sr)]
  bool two_sided = true;     // false for lights, because lights emit from the fronts of their faces only
  bool passed_over = false;  // true if surfaces of this material are left out: the material is clear or void
  std::string left_out;  // what is left out of the material, such as "specular parts"; empty if nothing is
};

class RadMaterials {
 public:
  // True if a Radiance primitive of the type `type` is a material, a pattern, a texture or a mixture, not a
  // surface.
  static bool IsModifier(std::string_view type);

  // Adds the modifier that the primitive defines: a material, a pattern, a texture or a mixture. Throws
  // InputError, without file name and line, if the primitive has too few numbers.
  void Define(const RadPrimitive& primitive);
  // Gives an existing modifier a second name, as an `alias` primitive requires.
  void Alias(const RadPrimitive& primitive);

  // Returns the material of a surface whose modifier is called `modifier`. Throws InputError, without file
  // name and line, if the modifier is not defined.
  const RadMaterial& Find(std::string_view modifier) const;

 private:
  std::map<std::string, RadMaterial, std::less<>> materials_;
};

}  // namespace penumbra
