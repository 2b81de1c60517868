// penumbra view: a window on a scene.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/dim_option.h"
#include "apps/export_file.h"
#include "apps/load_scene.h"
#include "apps/material_change.h"
#include "apps/messages.h"
#include "apps/option_checks.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/report.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "display/viewer/script.h"
#include "display/viewer/user_files.h"
#include "display/viewer/viewer.h"
#include "display/viewer/window.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/processes.h"

namespace penumbra {
namespace {

constexpr const char* kTwoSided = "two-sided";
constexpr const char* kFlip = "flip";
constexpr const char* kRadiance = "emission-is-radiance";
constexpr const char* kMaxReflectance = "max-reflectance";
constexpr const char* kMaxOffPlane = "max-off-plane";
constexpr const char* kEmittanceOption = "emittance";
constexpr const char* kReflectanceOption = "reflectance";
constexpr const char* kRestart = "restart";
// Values of flags that are given and are not, and of other options that are not.
constexpr const char *kOn = "on", *kOff = "off";
const std::string kNone = "none";

struct ViewArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::optional<std::string> script;
  bool no_solve = false;
  std::optional<double> scale;  // of text and panels
};

// A window may have nobody to print to; main() tells whether it had.
void PrintLine(const std::string& line) {
  std::fwrite((line + "\n").data(), 1, line.size() + 1, stdout);
  std::fflush(stdout);
}

// What files bring into the window, and what it writes into them.
class ViewedScene {
 public:
  explicit ViewedScene(const SceneArguments& arguments) : arguments_(arguments) {}

  viewer::OpenedScene Take(LoadedScene loaded) {
    const std::lock_guard lock(mutex_);
    viewer::OpenedScene opened;
    opened.scene = std::move(loaded.owner);
    load_seconds_ = loaded.seconds;
    stored_options_.reset();
    if (loaded.stored) {
      stored_options_ = loaded.stored->options;
      opened.solving = loaded.stored->solving;
      opened.stored = std::make_shared<PipelineState>(std::move(loaded.stored->state));
    }
    if (loaded.restart) {
      opened.solving = loaded.restart->solving;
      opened.restart = std::make_shared<const PipelineState>(std::move(loaded.restart->state));
    }
    return opened;
  }

  // Another scene is read as this one was; changes of materials were made to this one alone, and links are of
  // this one.
  viewer::OpenedScene Open(const std::string& name) {
    SceneArguments other = Again();
    other.scene = name;
    other.emittance.clear();
    other.reflectance.clear();
    other.dims.clear();
    other.restart.reset();
    LoadedScene loaded = LoadScene(other);
    {
      const std::lock_guard lock(mutex_);
      arguments_ = std::move(other);
    }
    return Take(std::move(loaded));
  }

  // The scene that was opened last, with one option changed, in the words of the command line.
  viewer::OpenedScene ReadWith(const std::string& option, const std::string& value) {
    SceneArguments changed = Again();
    CLI::App app;
    AddSceneArguments(app, &changed);
    AddRestartOption(app, &changed);
    std::vector<std::string> words = {changed.scene};
    if (value == kOff || value == kNone) {
      LeaveOut(option, changed);
    } else {
      words.push_back(fmt::format("--{}", option));
      if (value != kOn) words.push_back(value);
    }
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    try {
      app.parse(std::move(words));
      LoadedScene loaded = LoadToSolve(changed);
      changed.app = nullptr;
      {
        const std::lock_guard lock(mutex_);
        arguments_ = std::move(changed);
      }
      return Take(std::move(loaded));
    } catch (const CLI::ParseError& error) {
      throw InputError(error.what());
    } catch (const UsageError& error) {
      throw InputError(error.what());
    }
  }

  std::vector<viewer::ReadingOption> Reading() const {
    const SceneOptions& reading = arguments_.reading;
    const auto flag = [](const bool& value) { return [&value] { return std::string(value ? kOn : kOff); }; };
    const auto changes = [](const std::vector<MaterialChange>& of) {
      return [&of] {
        std::vector<std::string> texts;
        for (const MaterialChange& change : of)
          texts.push_back(MaterialChangeText(change.material, change.value));
        return of.empty() ? kNone : fmt::format("{}", fmt::join(texts, " "));
      };
    };
    return {
        {kFlip, "Every face is turned", true, flag(reading.flip)},
        {kTwoSided, "Every face has a second, reversed one", true, flag(reading.two_sided)},
        {kRadiance, "Ke is radiance", true, flag(reading.emission_is_radiance)},
        {kMaxReflectance, "Clamp larger reflectances to", false,
         [&reading] {
           return reading.max_reflectance ? fmt::format("{}", *reading.max_reflectance) : kNone;
         }},
        {kMaxOffPlane, "Cut faces that are off their plane by up to", false,
         [&reading] { return reading.max_off_plane ? fmt::format("{}", *reading.max_off_plane) : kNone; }},
        {kEmittanceOption, "Another emittance, MATERIAL=r,g,b", false, changes(arguments_.emittance)},
        {kReflectanceOption, "Another reflectance, MATERIAL=r,g,b", false, changes(arguments_.reflectance)},
        {kRestart, "Over the links of a solution, its file", false,
         [this] { return arguments_.restart.value_or(kNone); }}};
  }

  // Called from the solver's thread.
  void Save(const std::string& path, const Pipeline& pipeline) const {
    const std::lock_guard lock(mutex_);
    KeepScene(path);
    WriteResult(path, SolutionFileOf(pipeline, OptionsOf(pipeline)));
  }

  // As well.
  void SaveReport(const std::string& path, const Pipeline& pipeline) const {
    const std::lock_guard lock(mutex_);
    KeepScene(path);
    nlohmann::ordered_json options = OptionsOf(pipeline);
    if (stored_options_) options["solution"] = arguments_.scene;
    WriteResult(path, ReportJson({options, load_seconds_, pipeline.report()}));
  }

  // The light of what is written from now on differs from that of the scene by this.
  void LitAs(const viewer::LightChange& change) {
    const std::lock_guard lock(mutex_);
    change_ = change;
  }

  // A function that brings back how the scene is read now.
  std::function<void()> KeepReading() {
    const std::lock_guard lock(mutex_);
    return [this, arguments = arguments_, stored = stored_options_, seconds = load_seconds_] {
      const std::lock_guard inner(mutex_);
      arguments_ = arguments;
      stored_options_ = stored;
      load_seconds_ = seconds;
    };
  }

  // Before a file is exported.
  void CheckExport(const std::string& path) const {
    const std::lock_guard lock(mutex_);
    KeepScene(path);
  }

 private:
  // Throws InputError if the file is the scene that is shown; a solution may be saved in its place.
  void KeepScene(const std::string& path) const {
    if (!stored_options_ && IsSameFile(path, arguments_.scene))
      throw InputError(fmt::format("'{}' is the scene that is shown; name another file", path));
  }

  nlohmann::ordered_json OptionsOf(const Pipeline& pipeline) const {
    SceneArguments told = arguments_;
    told.solving = pipeline.options();
    for (const Dimming& lamp : change_.lamps) told.dims.push_back(lamp);
    for (const viewer::Paint& paint : change_.paints)
      told.reflectance.push_back({paint.material, paint.reflectance});
    return stored_options_ ? StoredOptions(*stored_options_, told, pipeline.resolved())
                           : OptionsUsed(told, &pipeline.resolved());
  }

  // To read with once more: by as many threads as there are now, for the window may have been told so.
  SceneArguments Again() const {
    SceneArguments again = arguments_;
    again.app = nullptr;
    again.threads = ThreadCount();
    return again;
  }

  static void LeaveOut(const std::string& option, SceneArguments& arguments) {
    if (option == kFlip) arguments.reading.flip = false;
    if (option == kTwoSided) arguments.reading.two_sided = false;
    if (option == kRadiance) arguments.reading.emission_is_radiance = false;
    if (option == kMaxReflectance) arguments.reading.max_reflectance.reset();
    if (option == kMaxOffPlane) arguments.reading.max_off_plane.reset();
    if (option == kEmittanceOption) arguments.emittance.clear();
    if (option == kReflectanceOption) arguments.reflectance.clear();
    if (option == kRestart) arguments.restart.reset();
  }

  mutable std::mutex mutex_;
  SceneArguments arguments_;
  viewer::LightChange change_;
  std::optional<nlohmann::ordered_json> stored_options_;
  double load_seconds_ = 0;
};

viewer::ViewerFiles FilesOf(ViewedScene& viewed) {
  viewer::ViewerFiles files;
  files.open = [&viewed](const std::string& name) { return viewed.Open(name); };
  files.reading = viewed.Reading();
  files.read_with = [&viewed](const std::string& option, const std::string& value) {
    return viewed.ReadWith(option, value);
  };
  files.save_solution = [&viewed](const std::string& path, const Pipeline& pipeline) {
    viewed.Save(path, pipeline);
  };
  files.lit_as = [&viewed](const viewer::LightChange& change) { viewed.LitAs(change); };
  files.keep_reading = [&viewed] { return viewed.KeepReading(); };
  files.save_report = [&viewed](const std::string& path, const Pipeline& pipeline) {
    viewed.SaveReport(path, pipeline);
  };
  files.exports_mesh = [](const std::string& path) {
    if (const std::optional<std::string> error = ExportFormatError(path)) throw InputError(*error);
    return ExportsMesh(path);
  };
  files.export_file = [&viewed](const std::string& path, const Scene& scene, const IrradianceMesh* mesh,
                                const Camera& camera) {
    viewed.CheckExport(path);
    if (mesh)
      ExportMesh(path, {scene, *mesh, camera});
    else
      ExportScene(path, scene, camera);
  };
  return files;
}

void View(ViewArguments arguments) {
  if (ProcessCount() > 1)
    throw UsageError("one process shows the window; start `penumbra view` without mpirun");
  std::optional<viewer::Script> script;
  if (arguments.script) script = viewer::ReadScript(*arguments.script);
  const PipelineOptions solving = arguments.scene.solving;  // as they are without --restart
  LoadedScene loaded = LoadToSolve(arguments.scene);
  // Chosen before the window opens: a camera that is not there is a usage error.
  const Camera camera = ChooseCamera(loaded.scene, arguments.camera);
  if (arguments.scene.verbose) {
    const ResolvedOptions resolved = Resolve(loaded.scene, arguments.scene.solving);
    PrintOptionsUsed(loaded.stored ? loaded.stored->options : OptionsUsed(arguments.scene, &resolved));
  }
  if (!loaded.stored) {
    const std::string note = CostNote(arguments.scene, Resolve(loaded.scene, arguments.scene.solving));
    if (!note.empty()) Say(note);
  }

  ViewedScene viewed(arguments.scene);
  // A script must not depend on what someone did before, nor leave anything behind.
  std::optional<viewer::UserFiles> files;
  if (!script) files.emplace();
  viewer::ViewerOptions options;
  options.scene_name = arguments.scene.scene;
  options.files = FilesOf(viewed);
  options.solving = solving;
  options.solve = !arguments.no_solve;
  options.print = &PrintLine;
  viewer::Viewer* opened_in = nullptr;
  const auto remember = [&](const std::string& name) {
    if (!files) return;
    files->AddRecent(name);
    if (opened_in) opened_in->SetRecent(files->Recent());
  };
  options.opened = remember;
  if (files) {
    options.kept_cameras = [&files](const std::string& scene) { return files->Cameras(scene); };
    options.keep_camera = [&files](const std::string& scene, const Camera& kept) {
      files->KeepCamera(scene, kept);
    };
  }
  viewer::Viewer viewer(viewed.Take(std::move(loaded)), std::move(options));
  opened_in = &viewer;
  viewer.GoTo(camera);
  remember(arguments.scene.scene);
  viewer::RunWindow(viewer, script ? &*script : nullptr, files ? &*files : nullptr, arguments.scale);
}

// The options that a script can set, with what they may be.
std::string SettingsHelp() {
  std::string help = "Options for `set`, with their values at the start:\n";
  ViewedScene viewed{SceneArguments()};
  const viewer::Viewer viewer(viewer::OpenedScene(std::make_shared<const Scene>()), [&viewed] {
    viewer::ViewerOptions options;
    options.files = FilesOf(viewed);
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
  CLI::App* app = program.add_subcommand(
      "view", "Open a window on a scene or a solution: solve it, walk through it, look into it");
  const auto arguments = std::make_shared<ViewArguments>();
  AddSceneArguments(*app, &arguments->scene);
  app->add_option(
         "--script", arguments->script,
         "Play the actions in FILE, then end; the window hears nobody else, and nothing is remembered")
      ->type_name("FILE")
      ->group("Window");
  app->add_flag("--no-solve", arguments->no_solve, "Do not begin to solve: wait for the user")
      ->group("Window");
  AddNumber(*app, "--scale", &arguments->scale,
            {[](double x) { return x >= 0.5 && x <= 8; }, "a number from 0.5 to 8"},
            "Text and panels so many times as large (default: as the monitor has it; with --script 1)")
      ->group("Window");
  app->add_flag_callback(
         "--help-script",
         [] {
           WriteResult(std::nullopt, fmt::format("{}\n\n{}", viewer::kScriptHelp, SettingsHelp()));
           throw CLI::Success();
         },
         "Print the actions, options and menus that scripts know, and exit")
      ->group("Window");
  AddCameraOptions(*app, &arguments->camera, &arguments->scene.reading.up);
  AddDimOption(*app, &arguments->scene);
  AddSolveOptions(*app, &arguments->scene);
  AddRestartOption(*app, &arguments->scene);
  app->footer(std::string(viewer::kScriptHelp) +
              "\n`penumbra view --help-script` lists all options and menus.");
  return {app, [arguments] { View(*arguments); }};
}

}  // namespace penumbra
