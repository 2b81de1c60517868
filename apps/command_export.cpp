// penumbra export: meshes with their light, and scenes, for other programs.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/export_file.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"

namespace penumbra {
namespace {

struct ExportArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string output;
  std::optional<double> exposure;  // [m^2/W]; metered if not given
};

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
  const std::string format = std::filesystem::path(arguments.output).extension().string();
  if (arguments.exposure && format != ".ply" && format != ".glb")
    throw UsageError(
        fmt::format("--exposure is of the colours in .ply and .glb, and {} has none; leave it out", format));
  const CameraArguments& camera = arguments.camera;
  if (format != ".pbrt" &&
      (camera.camera || camera.eye || camera.look_at || camera.up || camera.vertical_fov))
    throw UsageError(fmt::format("a camera is of .pbrt, and {} has none; leave its options out", format));
}

void Export(ExportArguments arguments) {
  RefuseIdle(arguments);
  if (!ExportsMesh(arguments.output)) RefuseSolve(arguments);
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  if (const std::optional<std::string> library = LibraryBeside(arguments.output))
    arguments.scene.outputs.Add("the library of -o", *library);
  LoadedScene loaded = LoadToSolve(arguments.scene);
  if (!ExportsMesh(arguments.output)) {
    if (arguments.scene.verbose) PrintOptionsUsed(OptionsUsed(arguments.scene, nullptr));
    ExportScene(arguments.output, loaded.scene, ChooseCamera(loaded.scene, arguments.camera));
    return;
  }
  SolveRun run(arguments.scene, loaded);
  run.Run(MeshKind::kInterpolant, WantsReport(arguments.scene));
  ExportMesh(arguments.output, loaded.scene, run.pipeline().mesh(), arguments.exposure);
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
            "Brightness of the colours in .ply and .glb, 0 to 1, per W/m^2 (default: metered from the mesh)");
  AddCameraOptions(*app, &arguments->camera);
  AddSolveOptions(*app, &arguments->scene);
  AddRestartOption(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  app->footer(
      "With the light, which is solved for first:\n"
      "  .vtu   VTK, ParaView: quadratic triangles, the interpolants themselves; irradiance, radiosity, "
      "patch\n"
      "  .ply   binary: vertices with irradiance, radiosity [W/m^2] and colours; four triangles for each\n"
      "  .glb   glTF 2.0: the same triangles, unlit, y up; _IRRADIANCE and _RADIOSITY as attributes\n"
      "The scene alone, nothing is solved:\n"
      "  .obj   with an .mtl beside it; read again it is the same scene\n"
      "  .pbrt  pbrt 4, with the camera; area lights of radiance emittance/pi\n"
      "  .mgf   Materials and Geometry Format, for RenderPark; one-sided polygons");
  return {app, [arguments] { Export(*arguments); }};
}

}  // namespace penumbra
