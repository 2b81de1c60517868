// penumbra view: a window on a scene.

#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/scene_arguments.h"
#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"
#include "display/viewer/window.h"

namespace penumbra {
namespace {

struct ViewArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> script;
  bool no_solve = false;
};

void PrintLine(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void View(const ViewArguments& arguments) {
  std::optional<viewer::Script> script;
  if (arguments.script) script = viewer::ReadScript(*arguments.script);
  LoadedScene loaded = LoadScene(arguments.scene);
  // Chosen before the window opens: a camera that is not there is a usage error.
  Camera camera = ChooseCamera(loaded.scene, arguments.camera);

  // A script must not depend on what someone did before, nor leave anything behind.
  std::optional<viewer::UserFiles> files;
  if (!script) files.emplace();
  viewer::ViewerOptions options;
  options.scene_name = arguments.scene.scene;
  options.reading = arguments.scene.reading;
  options.solving = arguments.scene.solving;
  options.solve = !arguments.no_solve;
  options.print = &PrintLine;
  viewer::Viewer* opened_in = nullptr;
  const auto remember = [&](const std::string& name) {
    if (!files) return;
    files->AddRecent(name);
    if (opened_in) opened_in->SetRecent(files->Recent());
  };
  options.opened = remember;
  viewer::Viewer viewer(std::make_shared<const Scene>(std::move(loaded.scene)), std::move(options));
  opened_in = &viewer;
  viewer.GoTo(camera);
  remember(arguments.scene.scene);
  viewer::RunWindow(viewer, script ? &*script : nullptr, files ? &*files : nullptr);
}

// The options that a script can set, with what they may be.
std::string SettingsHelp() {
  std::string help = "Options for `set`, with their values at the start:\n";
  const viewer::Viewer viewer(std::make_shared<const Scene>(), [] {
    viewer::ViewerOptions options;
    options.solve = false;
    return options;
  }());
  for (const viewer::Setting& setting : viewer.settings().all()) {
    const std::string values =
        setting.choices.empty() ? setting.get() : fmt::format("{}", fmt::join(setting.choices, "|"));
    help += fmt::format("  {:<26} {} ({})\n", setting.name, setting.help, values);
  }
  help += "\nMenus, with their keys:\n";
  for (const viewer::MenuItem& item : viewer.menu().items())
    help += fmt::format("  {:<52} {}\n", item.path, item.key);
  return help;
}

}  // namespace

Command AddViewCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("view", "Open a window on a scene: solve it, walk through it, look into it");
  const auto arguments = std::make_shared<ViewArguments>();
  AddSceneArguments(*app, &arguments->scene);
  app->add_option(
         "--script", arguments->script,
         "Play the actions in FILE, then end; the window hears nobody else, and nothing is remembered")
      ->type_name("FILE")
      ->group("Window");
  app->add_flag("--no-solve", arguments->no_solve, "Do not begin to solve: wait for the user")
      ->group("Window");
  app->add_flag_callback(
         "--help-script",
         [] {
           fmt::print("{}\n\n{}", viewer::kScriptHelp, SettingsHelp());
           throw CLI::Success();
         },
         "Print the actions, options and menus that scripts know, and exit")
      ->group("Window");
  AddCameraOptions(*app, &arguments->camera);
  AddSolveOptions(*app, &arguments->scene);
  app->footer(std::string(viewer::kScriptHelp) +
              "\n`penumbra view --help-script` lists all options and menus.");
  return {app, [arguments] { View(*arguments); }};
}

}  // namespace penumbra
