// solver/scene/rad_materials.h
//
// What Radiance's materials are to a solver that knows diffuse surfaces only.

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
  Material material;         // its emittance is radiance [W/(m^2 sr)]
  bool two_sided = true;     // lights shine from their fronts only
  bool passed_over = false;  // surfaces of it are left out: they are clear, or nothing
  std::string left_out;  // what is left out of the material, such as "specular parts"; empty if nothing is
};

class RadMaterials {
 public:
  // Whether the type is one of a material, a pattern, a texture or a mixture, and not of a surface.
  static bool IsModifier(std::string_view type);

  // Defines a modifier. Throws InputError, without a place, if it has too few numbers.
  void Define(const RadPrimitive& primitive);
  // Gives a modifier a further name.
  void Alias(const RadPrimitive& primitive);

  // The material of a surface with this modifier. Throws InputError, without a place, if it is not defined.
  const RadMaterial& Find(std::string_view modifier) const;

 private:
  std::map<std::string, RadMaterial, std::less<>> materials_;
};

}  // namespace penumbra
