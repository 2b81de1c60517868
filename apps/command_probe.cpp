// penumbra probe: irradiance at points, exact and interpolated.

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/dim_option.h"
#include "apps/interruptible.h"
#include "apps/messages.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/photometric_option.h"
#include "apps/points_csv.h"
#include "apps/probe.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "solver/transport/sources/source_set.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/pair/patch_visibility.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {
namespace {

struct ProbeArguments {
  SceneArguments scene;
  std::string points;
  std::optional<std::string> output;
  std::string method = "auto";
  bool direct = false;
  ProbeColumns columns;
};

// What a probe may be told beside the options of a solve.
nlohmann::ordered_json ProbeOptions(const ProbeArguments& arguments) {
  return {{"method", arguments.method}, {"direct", arguments.direct}, {"parts", arguments.columns.parts}};
}

std::vector<Measurement> Measure(const Prober& prober, const std::vector<ProbePoint>& points) {
  std::vector<Measurement> measurements;
  RunInterruptible([&](const ExecutionContext& context) { measurements = prober.Measure(points, context); });
  return measurements;
}

// Only what surfaces emit of themselves: nothing is solved.
std::vector<Measurement> MeasureDirect(const ProbeArguments& arguments, const Scene& scene,
                                       const std::vector<ProbePoint>& points,
                                       const PointIrradianceOptions& how) {
  if (arguments.scene.verbose) {
    nlohmann::ordered_json options = OptionsUsed(arguments.scene, nullptr);
    options.update(ProbeOptions(arguments));
    PrintOptionsUsed(options);
  }
  const PatchVisibility unused;  // which patch sees which matters on patches only; points may lie anywhere
  const SourceSet sources = SourceSet::Emitters(scene);
  const PointIrradiance irradiance(scene, unused, sources, how);
  return Measure(Prober(scene, irradiance, nullptr, arguments.columns.parts), points);
}

void CheckMethod(const ProbeArguments& arguments) {
  if (arguments.scene.solving.point.min_backprojection_segment > 0 && arguments.method != kFastestOcclusion &&
      arguments.method != "backprojection")
    throw UsageError(
        fmt::format("--min-backprojection-segment is of backprojection, and --method {} is another; leave "
                    "one of them out",
                    arguments.method));
}

void Probe(ProbeArguments arguments, std::vector<ProbePoint> points) {
  LoadedScene loaded = LoadToSolve(arguments.scene);
  TakeNormalsOfFaces(loaded.scene, NameOfPoints(arguments.points), &points);

  PointIrradianceOptions how = loaded.stored ? loaded.stored->solving.point : arguments.scene.solving.point;
  const std::unique_ptr<const OcclusionMethod> method =
      MakeOcclusion(arguments.method, {how.min_backprojection_segment});
  how.method = method.get();

  std::vector<Measurement> measurements;
  std::optional<SolveRun> run;
  if (arguments.direct) {
    measurements = MeasureDirect(arguments, loaded.scene, points, how);
  } else {
    run.emplace(arguments.scene, loaded, ProbeOptions(arguments));
    run->Run(MeshKind::kInterpolant, WantsReport(arguments.scene));
    const Pipeline& pipeline = run->pipeline();
    const PointIrradiance irradiance(pipeline.solution(), pipeline.visibility(), how);
    measurements = Measure(Prober(loaded.scene, irradiance, &pipeline, arguments.columns.parts), points);
  }

  CheckMeasurements(measurements);
  const std::string warning = SurroundingsWarning(measurements);
  if (!warning.empty()) Say("warning: " + warning);
  if (run) run->Tell();
  WriteResult(arguments.output, MeasurementsCsv(measurements, arguments.columns));
}

// The points are read once, whatever the number of scenes: standard input cannot be read twice.
void ProbeAll(ProbeArguments arguments) {
  CheckMethod(arguments);
  RefuseForSeveralScenes(arguments.scene, "-o", arguments.output);
  RefuseForSeveralScenes(arguments.scene, "--report", arguments.scene.report);
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  if (arguments.points != kPointsFromInput) arguments.scene.outputs.RefuseInput(arguments.points);
  const std::vector<ProbePoint> points = ReadPointsCsv(arguments.points);
  for (const std::string& scene : arguments.scene.scenes) {
    arguments.scene.scene = scene;
    Probe(arguments, points);
  }
}

}  // namespace

Command AddProbeCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand("probe", "Measure irradiance at points, exact and interpolated");
  const auto arguments = std::make_shared<ProbeArguments>();
  AddSeveralScenesArguments(*app, &arguments->scene);
  app->add_option(
         "--points", arguments->points,
         "The points [m] and normals, of any length: a CSV file with the header x,y,z,nx,ny,nz, or - for "
         "standard input; points may lie on surfaces or in free space; on faces the normals may be left out")
      ->required()
      ->type_name("POINTS.csv");
  app->add_option("-o,--output", arguments->output, "Write the rows here (default: standard output)")
      ->type_name("OUT.csv");
  CLI::Option* direct =
      app->add_flag("--direct", arguments->direct,
                    "Only what surfaces emit of themselves; nothing is solved or interpolated");
  app->add_flag(
      "--parts", arguments->columns.parts,
      "Add the share of direct light and the gradient of the irradiance by the point's position, its "
      "normal fixed [W/m^3]");
  AddPhotometricOption(*app, &arguments->columns.unit);
  app->add_option(
         "--method", arguments->method,
         "How occlusion is found at the points: auto, the fastest exact one; clipping, backprojection "
         "(thesis 6.2) and vertex-tracing (Stark and Riesenfeld 1999) are exact; sampled is what the thesis "
         "gave up; solves use auto")
      ->check(CLI::IsMember(OcclusionNames()))
      ->type_name("METHOD")
      ->capture_default_str();
  AddDimOption(*app, &arguments->scene);
  AddSolveOptions(*app, &arguments->scene);
  AddRestartOption(*app, &arguments->scene)->excludes(direct);
  AddReportOption(*app, &arguments->scene)->excludes(direct);
  app->footer(
      "Prints x,y,z,nx,ny,nz,patch,exact_r,exact_g,exact_b,interp_r,interp_g,interp_b, a row a point, in "
      "order,\n"
      "and with --parts direct_r,direct_g,direct_b,grad_r_x,grad_r_y, ... grad_b_z. With --photometric: "
      "exact_lux,\n"
      "interp_lux, direct_lux, grad_lux_x, ... Of several scenes, a table each, in order.\n"
      "exact: irradiance from the whole scene [W/m^2]; interp: the interpolant's where the point lies on "
      "the\n"
      "front of a face (within 1e-6 of the scene's diagonal, normals within 1 degree), else nan; patch: the\n"
      "number of that face's f line, from 0, else -1.");
  return {app, [arguments] { ProbeAll(*arguments); }};
}

}  // namespace penumbra
