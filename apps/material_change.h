// apps/material_change.h
//
// Emittances and reflectances given on the command line, which replace those in the scene file.

#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

#include "apps/option_values.h"
#include "solver/scene/scene.h"

namespace penumbra {

struct MaterialChange {
  std::string material;
  Rgb value = Rgb::Zero();
};

// Adds an option `NAME MATERIAL=r,g,b` to the command line; the option may be given several times. Each of
// the three numbers must satisfy `rule`.
CLI::Option* AddMaterialChange(CLI::App& app, const std::string& name, std::vector<MaterialChange>* changes,
                               const NumberRule& rule, const std::string& help);

// The option value `MATERIAL=r,g,b` by which a user would set the material's emittance or reflectance to
// `value`.
std::string MaterialChangeText(const std::string& material, const Rgb& value);

// Sets the emittance or the reflectance of materials, selected by `member`, to the values in `changes`. If
// several changes name the same material, the last change determines the value. Throws UsageError for a
// material that the scene does not have.
void ChangeMaterials(const std::vector<MaterialChange>& changes, Rgb Material::*member,
                     std::vector<Material>& materials);

}  // namespace penumbra
