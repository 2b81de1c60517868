// apps/material_change.h
//
// Emittances and reflectances from the command line that replace those of the file.

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

// Adds the repeatable option `NAME MATERIAL=r,g,b`. Each number must satisfy the rule.
CLI::Option* AddMaterialChange(CLI::App& app, const std::string& name, std::vector<MaterialChange>* changes,
                               const NumberRule& rule, const std::string& help);

// The text `MATERIAL=r,g,b`, as the user gives it.
std::string MaterialChangeText(const std::string& material, const Rgb& value);

// Applies the changes to `member` of the materials, in order, so that the last change of a material
// determines its value. Throws UsageError for a material that the scene does not have.
void ChangeMaterials(const std::vector<MaterialChange>& changes, Rgb Material::*member,
                     std::vector<Material>& materials);

}  // namespace penumbra
