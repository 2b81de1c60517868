// penumbra export: meshes with their light, and scenes, for other programs.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/camera_arguments.h"
#include "apps/commands.h"
#include "apps/option_values.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "apps/solve_run.h"
#include "display/mesh_export.h"
#include "solver/scene/mgf_writer.h"
#include "solver/scene/obj_writer.h"
#include "solver/scene/pbrt_writer.h"

namespace penumbra {
namespace {

constexpr std::array<const char*, 3> kMeshFormats = {".vtu", ".ply", ".glb"},
                                     kSceneFormats = {".obj", ".pbrt", ".mgf"};
constexpr int kFilmWidth = 1280, kFilmHeight = 960;  // what pbrt draws [pixels]

struct ExportArguments {
  SceneArguments scene;
  CameraArguments camera;
  std::string output;
  std::optional<double> exposure;  // [m^2/W]; metered if not given
};

std::string FormatOf(const std::string& path) { return std::filesystem::path(path).extension().string(); }

bool Contains(const std::array<const char*, 3>& formats, const std::string& format) {
  return std::find(formats.begin(), formats.end(), format) != formats.end();
}

void ExportMesh(const ExportArguments& arguments, LoadedScene& loaded) {
  const std::string format = FormatOf(arguments.output);
  SolveRun run(arguments.scene, loaded);
  run.Run(MeshKind::kInterpolant, WantsReport(arguments.scene));
  const IrradianceMesh& mesh = run.pipeline().mesh();
  if (format == ".vtu") {
    WriteResult(arguments.output, VtuBytes(loaded.scene, mesh));
  } else {
    const double exposure = arguments.exposure.value_or(MeterMesh(loaded.scene, mesh));
    WriteResult(arguments.output, format == ".ply" ? PlyBytes(loaded.scene, mesh, exposure)
                                                   : GlbBytes(loaded.scene, mesh, exposure));
  }
  run.Tell();
}

void ExportScene(const ExportArguments& arguments, const Scene& scene) {
  const std::string format = FormatOf(arguments.output);
  if (format == ".pbrt") {
    const Camera camera = ChooseCamera(scene, arguments.camera);
    WriteResult(arguments.output, PbrtText(scene, camera, kFilmWidth, kFilmHeight));
  } else if (format == ".mgf") {
    WriteResult(arguments.output, MgfText(scene));
  } else {
    std::filesystem::path library = arguments.output;
    library.replace_extension(".mtl");
    CheckWritable(library.string());
    WriteResult(library.string(), MtlText(scene));
    WriteResult(arguments.output, ObjText(scene, library.filename().string()));
  }
}

void Export(const ExportArguments& arguments) {
  CheckWritable(arguments.output);
  if (arguments.scene.report) CheckWritable(*arguments.scene.report);
  LoadedScene loaded = LoadScene(arguments.scene);
  if (Contains(kMeshFormats, FormatOf(arguments.output))) {
    ExportMesh(arguments, loaded);
    return;
  }
  if (arguments.scene.verbose) PrintOptionsUsed(OptionsUsed(arguments.scene, nullptr));
  ExportScene(arguments, loaded.scene);
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
           if (!Contains(kMeshFormats, FormatOf(path)) && !Contains(kSceneFormats, FormatOf(path)))
             throw CLI::ValidationError(
                 "-o", fmt::format("'{}' ends in none of .vtu, .ply, .glb, .obj, .pbrt, .mgf", path));
           arguments->output = path;
         },
         "Where to; the ending decides what is written")
      ->required()
      ->type_name("FILE");
  AddNumber(*app, "--exposure", &arguments->exposure, kPositive,
            "Brightness of the colours in .ply and .glb, 0 to 1, per W/m^2 (default: metered from the mesh)");
  AddCameraOptions(*app, &arguments->camera);
  AddSolveOptions(*app, &arguments->scene);
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
