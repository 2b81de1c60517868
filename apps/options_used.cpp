#include "apps/options_used.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "apps/material_change.h"
#include "apps/messages.h"
#include "mesh/pipeline/link_options.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

Json ValueJson(const OptionValue& value) {
  return std::visit([](const auto& held) { return Json(held); }, value);
}

OptionValue ValueFrom(const Json& json, OptionKind kind) {
  switch (kind) {
    case OptionKind::kFlag:
      return json.get<bool>();
    case OptionKind::kInteger:
      return json.get<std::uint64_t>();
    case OptionKind::kNumber:
      return json.get<double>();
    case OptionKind::kChoice:
      break;
  }
  return json.get<std::string>();
}

// The text as one word of a shell.
std::string ShellWord(const std::string& text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%^";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The option as it would be given; nothing for a flag that was not.
std::string GivenText(const std::string& name, const Json& value) {
  if (value.is_boolean()) {
    const SolveOption* option = FindOption(name);
    if (value.get<bool>() == (option && option->flag_clears)) return "";
    return fmt::format("   {}\n", option ? CommandLineName(*option) : "--" + name);
  }
  if (value.is_object()) {  // of materials
    std::string text;
    for (const auto& [material, rgb] : value.items())
      text += fmt::format("   --{} {}\n", name,
                          ShellWord(MaterialChangeText(
                              material, {rgb[0].get<double>(), rgb[1].get<double>(), rgb[2].get<double>()})));
    return text;
  }
  return fmt::format("   --{} {}\n", name,
                     value.is_string() ? ShellWord(value.get<std::string>()) : value.dump());
}

}  // namespace

Json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved) {
  Json options;
  options["scene"] = arguments.scene;
  options["emission_is_radiance"] = arguments.reading.emission_is_radiance;
  options["flip"] = arguments.reading.flip;
  options["two_sided"] = arguments.reading.two_sided;
  if (arguments.reading.strict) options["strict"] = true;
  if (arguments.reading.unit) options["unit"] = arguments.reading.unit->name;
  if (arguments.reading.up) options["up"] = NameOf(*arguments.reading.up);
  if (arguments.reading.max_reflectance) options["max_reflectance"] = *arguments.reading.max_reflectance;
  if (arguments.reading.max_off_plane) options["max_off_plane"] = *arguments.reading.max_off_plane;
  for (const auto& [name, changes] :
       {std::pair("emittance", &arguments.emittance), std::pair("reflectance", &arguments.reflectance)})
    for (const MaterialChange& change : *changes)
      options[name][change.material] = {change.value[0], change.value[1], change.value[2]};
  for (const Dimming& dimming : arguments.dims)
    options["dim"][dimming.name] = {dimming.factor[0], dimming.factor[1], dimming.factor[2]};
  options["threads"] = ThreadCount();
  for (const SolveOption& option : OptionTable())
    if (option.group == OptionGroup::kRunning)
      options[OptionKey(option)] = ValueJson(*option.field.get(arguments.solving));
  if (!resolved) return options;
  for (const auto& [option, value] : UsedOptions(arguments.solving, *resolved))
    options[OptionKey(*option)] = ValueJson(value);
  if (arguments.restart) options["restart"] = *arguments.restart;
  return options;
}

PipelineOptions SolvingFrom(const Json& options) {
  return OptionsToldBy([&](const SolveOption& option) -> std::optional<OptionValue> {
    const auto told = options.find(OptionKey(option));
    if (told == options.end()) return std::nullopt;
    return ValueFrom(*told, option.field.kind);
  });
}

void PrintOptionsUsed(const Json& options) {
  // A solution was made of the scene by these, which stand for it.
  std::string block = options.contains("solution")
                          ? fmt::format("Options used, and those that '{}' was solved with:\n",
                                        options["solution"].get<std::string>())
                          : "Options used:\n";
  for (const auto& [key, value] : options.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    // The links of a restart were made with its options, which may not be given again.
    const bool of_restart = options.contains("restart") && IsLinkOption(name);
    if (key == "scene")
      block += fmt::format("   {}\n", ShellWord(value.get<std::string>()));
    else if (key != "solution" && !of_restart)
      block += GivenText(name, value);
  }
  PrintText(block);
}

}  // namespace penumbra
