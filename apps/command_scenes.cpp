// penumbra scenes: the built-in scenes.

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "apps/commands.h"
#include "apps/output.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

void ListScenes() {
  std::size_t width = 0;
  for (const BuiltinScene& scene : BuiltinScenes()) width = std::max(width, scene.name.size());
  std::string lines;
  for (const BuiltinScene& scene : BuiltinScenes())
    lines += fmt::format("{:<{}}  {}\n", scene.name, width, scene.description);
  WriteResult(std::nullopt, lines);
}

}  // namespace

Command AddScenesCommand(CLI::App& program) {
  return {program.add_subcommand("scenes", "List the built-in scenes, a line each"), [] { ListScenes(); }};
}

}  // namespace penumbra
