// apps/material_change.h
//
// Emittances and reflectances on the command line, which replace those of the scene file.

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

// Adds the option `NAME MATERIAL=r,g,b`, which may be given several times. Each number must satisfy the rule.
CLI::Option* AddMaterialChange(CLI::App& app, const std::string& name, std::vector<MaterialChange>* changes,
                               const NumberRule& rule, const std::string& help);

// The text `MATERIAL=r,g,b` that a user would give for this change.
std::string MaterialChangeText(const std::string& material, const Rgb& value);

// Sets `member`, emittance or reflectance, of the materials to the new values. If several changes concern the
// same material, the last change determines the value. Throws UsageError for a material that the scene does
// not have.
void ChangeMaterials(const std::vector<MaterialChange>& changes, Rgb Material::*member,
                     std::vector<Material>& materials);

}  // namespace penumbra
