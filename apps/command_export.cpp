// penumbra export: meshes with their light, and scenes, for other programs.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/dim_option.h"
#include "apps/export_file.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "solver/base/file_endings.h"

namespace penumbra {
namespace {

struct ExportArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string output;
  std::optional<double> exposure;  // [m^2/W]; metered if not given
  int atlas = 0;                   // pixels a side of an irradiance map; 0: none is wanted
  AtlasPlaces places = AtlasPlaces::kOwn;
};

constexpr Choice<AtlasPlaces> kPlaces[] = {{"own", AtlasPlaces::kOwn}, {"scene", AtlasPlaces::kScene}};

// Where the scene alone is written, nothing can be said of a solve.
void RefuseSolve(const ExportArguments& arguments) {
  for (const auto& [name, value] :
       {std::pair("--report", &arguments.scene.report), std::pair("--restart", &arguments.scene.restart)})
    if (*value)
      throw UsageError(fmt::format("{} is of a solve, and nothing is solved for '{}'; leave it out", name,
                                   arguments.output));
}

// Options that the format has no use for.
void RefuseIdle(const ExportArguments& arguments) {
  const std::string format = fmt::format(".{}", EndingOf(arguments.output));
  const bool map = arguments.atlas > 0;
  if (IsGiven(arguments.scene, "--uv") && !map)
    throw UsageError("--uv is of irradiance maps; give the size of one by --atlas N, or leave it out");
  if (map && !ExportsMap(arguments.output))
    throw UsageError(fmt::format("--atlas makes a map of {}, and {} is no such format; leave it out",
                                 EndingsOfMaps(), format));
  if (!map && IsMapOnly(arguments.output))
    throw UsageError(
        fmt::format("{} holds an irradiance map; give its size by --atlas N, such as --atlas 1024", format));
  if (arguments.exposure && !(map ? format != ".exr" : ExportsColours(arguments.output)))
    throw UsageError(fmt::format(
        "--exposure is of the colours in {}, and of maps other than .exr, and {} has none; leave it out",
        EndingsWithColours(), format));
  const CameraArguments& camera = arguments.camera;
  if ((map || !ExportsCamera(arguments.output)) &&
      (camera.camera || camera.eye || camera.look_at || camera.up || camera.vertical_fov))
    throw UsageError(fmt::format("a camera is of {}, and {} has none; leave its options out",
                                 EndingsWithCamera(), map ? "a map" : format));
}

void Export(ExportArguments arguments) {
  RefuseIdle(arguments);
  const bool map = arguments.atlas > 0, lit = map || ExportsMesh(arguments.output);
  if (!lit) RefuseSolve(arguments);
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  for (const std::string& library : FilesBeside(arguments.output))
    arguments.scene.outputs.Add("the library of -o", library);
  LoadedScene loaded = LoadToSolve(arguments.scene);
  const Camera camera = ChooseCamera(loaded.scene, arguments.camera);
  if (!lit) {
    if (arguments.scene.verbose) PrintOptionsUsed(OptionsUsed(arguments.scene, nullptr));
    ExportScene(arguments.output, loaded.scene, camera);
    return;
  }
  SolveRun run(arguments.scene, loaded);
  run.Run(MeshKind::kInterpolant, WantsReport(arguments.scene));
  const MeshExport from{run.pipeline().scene(), run.pipeline().mesh(), camera, arguments.exposure};
  if (map)
    ExportMap(arguments.output, from, arguments.atlas, arguments.places);
  else
    ExportMesh(arguments.output, from);
  run.Tell();
}

}  // namespace

Command AddExportCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("export", "Write the mesh with its light, or the scene, for other programs");
  const auto arguments = std::make_shared<ExportArguments>();
  AddSceneArguments(*app, &arguments->scene);
  app->add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           if (const std::optional<std::string> error = ExportFormatError(path))
             throw CLI::ValidationError("-o", *error);
           arguments->output = path;
         },
         "Where to; the ending decides what is written")
      ->required()
      ->type_name("FILE");
  AddNumber(*app, "--exposure", &arguments->exposure, kPositive,
            fmt::format("Brightness of the colours in {}, 0 to 1, per W/m^2 (default: metered from the mesh)",
                        EndingsWithColours()));
  AddInteger(*app, "--atlas", &arguments->atlas, 1, 16384,
             fmt::format("Write an irradiance map of N x N pixels to {} [pixels]", EndingsOfMaps()))
      ->default_str("");
  AddChoice(*app, "--uv", &arguments->places, kPlaces,
            "Where the light of a face lies on the map: own, a chart for each patch; or scene, at the face's "
            "texture coordinates in its file, the second set if there are two");
  AddCameraOptions(*app, &arguments->camera, &arguments->scene.reading.up);
  AddDimOption(*app, &arguments->scene);
  AddSolveOptions(*app, &arguments->scene);
  AddRestartOption(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  app->footer(ExportFormats());
  return {app, [arguments] { Export(*arguments); }};
}

}  // namespace penumbra
