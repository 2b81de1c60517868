#include "apps/material_change.h"

#include <fmt/format.h>

#include "apps/commands.h"
#include "solver/base/similar_names.h"

namespace penumbra {

CLI::Option* AddMaterialChange(CLI::App& app, const std::string& name, std::vector<MaterialChange>* changes,
                               const NumberRule& rule, const std::string& help) {
  const auto read = [=](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t equals = text.rfind('=');
      const std::optional<Vec3> value =
          equals == text.npos ? std::nullopt : ParseVector(std::string_view(text).substr(equals + 1));
      if (!value || !rule.holds(value->x()) || !rule.holds(value->y()) || !rule.holds(value->z()))
        throw CLI::ValidationError(name,
                                   fmt::format("'{}' is not MATERIAL=r,g,b, each {}", text, rule.words));
      changes->push_back({text.substr(0, equals), value->array()});
    }
  };
  return app.add_option_function<std::vector<std::string>>(name, read, help)
      ->type_name("MATERIAL=r,g,b")
      ->expected(1)
      ->take_all();
}

std::string MaterialChangeText(const std::string& material, const Rgb& value) {
  return fmt::format("{}={},{},{}", material, value[0], value[1], value[2]);
}

void ChangeMaterials(const std::vector<MaterialChange>& changes, Rgb Material::*member,
                     std::vector<Material>& materials) {
  for (const MaterialChange& change : changes) {
    bool found = false;
    for (Material& material : materials) {
      if (material.name != change.material) continue;
      material.*member = change.value;
      found = true;
    }
    if (found) continue;
    std::vector<std::string> names;
    for (const Material& material : materials) names.push_back(material.name);
    throw UsageError(fmt::format("the scene has no material '{}'; it has {}{}", change.material,
                                 names.empty() ? "none" : NameList(names),
                                 DidYouMean(change.material, names)));
  }
}

}  // namespace penumbra
