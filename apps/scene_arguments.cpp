#include "apps/scene_arguments.h"

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/option_values.h"
#include "mesh/pipeline/option_table.h"

namespace penumbra {
namespace {

constexpr int kMaxThreads = 1024;
// A vertex of a face is never farther off its plane than its diameter.
constexpr NumberRule kShareOfDiameter{[](double x) { return x >= 0 && x <= 1; }, "a number in [0, 1]"};
constexpr NumberRule kBelowOne{[](double x) { return x >= 0 && x < 1; }, "a number in [0, 1)"};

// The frame in which the scene is read.
void AddFrameOptions(CLI::App& app, SceneOptions* reading) {
  const auto read_unit = [reading](const std::string& text) {
    reading->unit = UnitNamed(text);
    if (!reading->unit)
      throw CLI::ValidationError("--unit", "'" + text + "' is no unit of length; give one of " + UnitNames() +
                                               ", or a number of metres");
  };
  app.add_option_function<std::string>(
         "--unit", read_unit,
         "The unit of the file's lengths: " + UnitNames() +
             ", or a number of metres. The default is what the file says, else m")
      ->type_name("UNIT")
      ->group(kSceneGroup);
  const auto read_up = [reading](const std::string& text) {
    reading->up = UpAxisNamed(text);
    if (!reading->up) throw CLI::ValidationError("--up", "'" + text + "' is not one of x|y|z");
  };
  app.add_option_function<std::string>(
         "--up", read_up,
         "The axis of the file that points up. The default is what the file or its format says, else z")
      ->type_name("x|y|z")
      ->group(kSceneGroup);
}

}  // namespace

void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose) {
  const std::string group = GroupTitle(OptionGroup::kRunning);
  AddInteger(app, "--threads", threads, 0, kMaxThreads,
             "Threads to work with, 0: all; the result is the same for any number")
      ->group(group);
  const SolveOption& entry = *FindOption("seed");
  const IntegerRange& range = entry.field.integers;
  AddInteger(app, CommandLineName(entry), seed, range.low, range.high, entry.help)->group(group);
  app.add_flag("-v,--verbose", *verbose,
               "Tell on standard error which options were used, and what a solve took and reached")
      ->group(group);
}

namespace {

constexpr const char* kSceneHelp =
    "A scene file (OBJ, glTF, ...), the name of a built-in scene (a file wins), or a solution that `solve "
    "-o` wrote";

// All but the scenes.
void AddReadingOptions(CLI::App& app, SceneArguments* arguments) {
  arguments->app = &app;
  app.add_flag("--emission-is-radiance", arguments->reading.emission_is_radiance,
               "Ke is radiance in W/(m^2 sr) instead of emittance in W/m^2: multiply it by pi")
      ->group(kSceneGroup);
  app.add_flag("--two-sided", arguments->reading.two_sided,
               "Repeat every face, reversed, after the last: the back of face i is n + i")
      ->group(kSceneGroup);
  app.add_flag(
         "--strict", arguments->reading.strict,
         "Refuse what is otherwise repaired and warned about: faces that are not planar, repeat vertices "
         "or have no area, materials and libraries that are not there, materials defined twice")
      ->group(kSceneGroup);
  app.add_flag("--flip", arguments->reading.flip,
               "Turn every face: what its vertices make the front becomes the back")
      ->group(kSceneGroup);
  AddFrameOptions(app, &arguments->reading);
  AddNumber(app, "--max-reflectance", &arguments->reading.max_reflectance, kBelowOne,
            "Clamp larger reflectances to X, in [0, 1), instead of refusing those of 1 or more")
      ->group(kSceneGroup);
  AddNumber(app, "--max-off-plane", &arguments->reading.max_off_plane, kShareOfDiameter,
            "Cut faces that are off their plane by up to X of their diameter into triangles, instead of 0.05")
      ->group(kSceneGroup);
  AddMaterialChange(app, "--emittance", &arguments->emittance, kEmittance,
                    "Another emittance for a material [W/m^2]; may be repeated")
      ->group(kSceneGroup);
  AddMaterialChange(app, "--reflectance", &arguments->reflectance, kBelowOne,
                    "Another reflectance for a material, in [0, 1); may be repeated")
      ->group(kSceneGroup);
  AddRunningOptions(app, &arguments->threads, &arguments->solving.seed, &arguments->verbose);
}

}  // namespace

void AddSceneArguments(CLI::App& app, SceneArguments* arguments) {
  app.add_option("SCENE", arguments->scene, kSceneHelp)->required()->type_name("");
  AddReadingOptions(app, arguments);
}

void AddSeveralScenesArguments(CLI::App& app, SceneArguments* arguments) {
  app.add_option("SCENE", arguments->scenes,
                 std::string(kSceneHelp) + "; of several, one result each, in order")
      ->required()
      ->type_name("");
  AddReadingOptions(app, arguments);
}

void RefuseForSeveralScenes(const SceneArguments& arguments, const std::string& name,
                            const std::optional<std::string>& file) {
  if (file && arguments.scenes.size() > 1)
    throw UsageError(
        fmt::format("{} '{}' is one file, and {} scenes are given; leave it out, or give one scene", name,
                    *file, arguments.scenes.size()));
}

CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments) {
  return app
      .add_option("--report", arguments->report,
                  "Write times, counts, iterations, energy balance and measured error here, as JSON")
      ->type_name("REPORT.json")
      ->group(GroupTitle(OptionGroup::kRunning));
}

CLI::Option* AddRestartOption(CLI::App& app, SceneArguments* arguments) {
  return app
      .add_option(
          "--restart", arguments->restart,
          "Light the scene over the links of this solution instead of linking and refining anew. It has to "
          "be one of the same geometry; emittances and reflectances may be others, in the file or by "
          "--emittance and --reflectance. No form factor is computed; corrections and the mesh are made as "
          "usual, by the options of this command. Options that say how links are made are refused")
      ->type_name("SOLUTION")
      ->group(GroupTitle(OptionGroup::kSolving));
}

bool IsGiven(const SceneArguments& arguments, const std::string& name) {
  const CLI::Option* option = arguments.app ? arguments.app->get_option_no_throw(name) : nullptr;
  return option && option->count() > 0;
}

}  // namespace penumbra
