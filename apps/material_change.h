// apps/material_change.h
//
// Other emittances and reflectances than those of the file, from the command line.

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

// `NAME MATERIAL=r,g,b`, as often as wanted; each number is what the rule says.
CLI::Option* AddMaterialChange(CLI::App& app, const std::string& name, std::vector<MaterialChange>* changes,
                               const NumberRule& rule, const std::string& help);

// `MATERIAL=r,g,b`, as it is given.
std::string MaterialChangeText(const std::string& material, const Rgb& value);

// Gives materials other values; of several changes of one material the last holds. Throws UsageError for one
// that the scene does not have.
void ChangeMaterials(const std::vector<MaterialChange>& changes, Rgb Material::*member,
                     std::vector<Material>& materials);

}  // namespace penumbra
