// penumbra methods: the methods that the program has for each task.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "apps/commands.h"
#include "apps/output.h"
#include "apps/render_arguments.h"
#include "display/image_writers.h"
#include "display/mesh_writers.h"
#include "display/viewer/overlays.h"
#include "display/viewer/settings.h"
#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/pipeline/matrix_writers.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/scene_writers.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/light_solvers.h"
#include "solver/visibility/exact/occlusion_methods.h"

namespace penumbra {
namespace {

using MethodJson = nlohmann::ordered_json;

// Of an option that only one method uses: its default is a value, or the words that say what it follows from.
MethodJson ParameterJson(const std::string& name) {
  const SolveOption* option = FindOption(name);
  PENUMBRA_CHECK(option != nullptr);
  MethodJson parameter = {
      {"name", name}, {"unit", option->unit}, {"default", nullptr}, {"help", option->help}};
  if (const std::optional<OptionValue> value = DefaultValue(*option))
    parameter["default"] = std::visit([](const auto& held) { return MethodJson(held); }, *value);
  else if (*option->otherwise)
    parameter["default"] = option->otherwise;
  return parameter;
}

// Adds the methods of a registry to those of a kind. `describe` makes a parameter of its name.
template <class Methods>
void AddMethods(const Methods& registry, MethodJson* kind, const auto& describe) {
  for (const auto& method : registry.methods()) {
    MethodJson parameters = MethodJson::array();
    for (const std::string& name : method.parameters) parameters.push_back(describe(method, name));
    kind->push_back({{"name", method.name}, {"help", method.help}, {"parameters", parameters}});
  }
}

// The same where parameters are options of a solve.
template <class Methods>
void AddMethods(const Methods& registry, MethodJson* kind) {
  AddMethods(registry, kind, [](const auto&, const std::string& name) { return ParameterJson(name); });
}

// Adds the overlays of the window, whose parameters are its settings.
void AddOverlays(MethodJson* kind) {
  const auto describe = [](const viewer::OverlayRegistry::Method& overlay, const std::string& name) {
    viewer::OverlaySettings values;
    viewer::Settings settings;
    overlay.make()->AddSettings(&values, &settings);
    const viewer::Setting* setting = settings.Find(name);
    return MethodJson{{"name", name},
                      {"unit", ""},
                      {"default", setting ? MethodJson(setting->get()) : MethodJson()},
                      {"help", setting ? setting->help : "a setting of the window"}};
  };
  AddMethods(viewer::Overlays(), kind, describe);
}

// Every method by kind, as JSON.
MethodJson AllMethods() {
  MethodJson kinds;
  AddMethods(LightSolvers(), &kinds["solver"]);
  AddMethods(LinkFormFactorMethods(), &kinds["form-factors"]);
  AddMethods(RefinementOracles(), &kinds["oracle"]);
  AddMethods(OcclusionMethods(), &kinds["occlusion"]);
  AddMethods(DiscontinuityChoices(), &kinds["discontinuities"]);
  for (const RenderMode& mode : kRenderModes)
    kinds["reconstruction"].push_back(
        {{"name", mode.name}, {"help", mode.help}, {"parameters", MethodJson::array()}});
  AddMethods(SceneReaders(), &kinds["reader"]);
  AddMethods(SceneWriters(), &kinds["writer"]);
  AddMethods(MeshWriters(), &kinds["writer"]);
  AddMethods(ImageWriters(), &kinds["image-writer"]);
  AddMethods(MatrixWriters(), &kinds["matrix-writer"]);
  AddOverlays(&kinds["overlay"]);
  return kinds;
}

std::string MethodsText(const MethodJson& kinds) {
  constexpr int kNameWidth = 16;
  std::string text;
  for (const auto& [kind, methods] : kinds.items()) {
    text += fmt::format("{}{}\n", text.empty() ? "" : "\n", kind);
    for (const MethodJson& method : methods) {
      text += fmt::format("  {:<{}}  {}\n", method["name"].get<std::string>(), kNameWidth,
                          method["help"].get<std::string>());
      for (const MethodJson& parameter : method["parameters"]) {
        const std::string unit = parameter["unit"];
        const MethodJson& value = parameter["default"];
        text += fmt::format("  {:<{}}    {}{} (default: {})\n", "", kNameWidth,
                            parameter["name"].get<std::string>(), unit.empty() ? "" : " [" + unit + "]",
                            value.is_string() ? value.get<std::string>() : value.dump());
      }
    }
  }
  return text;
}

}  // namespace

Command AddMethodsCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("methods", "List the methods that the program has for each task");
  const auto as_json = std::make_shared<bool>(false);
  app->add_flag("--json", *as_json, "Print JSON: of each kind a list of {name, help, parameters}");
  app->footer(
      "A method is chosen by its name: --solver, --form-factors, --oracle and --discontinuities of a solve,\n"
      "--method (occlusion) of probe, --mode (reconstruction) of render. The name of a writer is the ending\n"
      "of its files. Parameters are options that this method alone obeys.");
  return {app, [as_json] {
            const MethodJson kinds = AllMethods();
            WriteResult(std::nullopt, *as_json ? kinds.dump(2) + "\n" : MethodsText(kinds));
          }};
}

}  // namespace penumbra
