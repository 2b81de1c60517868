// penumbra grid: points on a working plane, and the light there.

#include <fmt/format.h>

#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/commands.h"
#include "apps/grid_statistics.h"
#include "apps/interruptible.h"
#include "apps/messages.h"
#include "apps/named_faces.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/photometric_option.h"
#include "apps/probe.h"
#include "apps/restart.h"
#include "apps/room_page.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "apps/surroundings.h"
#include "display/value_map.h"
#include "solver/base/file_endings.h"
#include "solver/base/parallel.h"
#include "solver/scene/work_grid.h"

namespace penumbra {
namespace {

constexpr NumberRule kHeight{[](double x) { return x >= -1e36 && x <= 1e36; }, "a number from -1e36 to 1e36"};
constexpr NumberRule kSpacing{[](double x) { return x >= 1e-6 && x <= 1e36; }, "a number from 1e-6 to 1e36"};

constexpr const char *kPointsEnding = "csv", *kPictureEnding = "svg", *kPageEnding = "html";

struct GridArguments {
  SceneArguments scene;
  std::optional<std::string> object, output;
  std::optional<double> plane;       // z [m]
  double height = 0, spacing = 0.5;  // [m]
  bool solve = false, as_json = false;
  LightUnit unit = LightUnit::kWatts;

  bool DrawsPicture() const { return output && EndingOf(*output) == kPictureEnding; }
  bool WritesPage() const { return output && EndingOf(*output) == kPageEnding; }
};

void CheckGrid(const GridArguments& arguments) {
  if (arguments.object.has_value() == arguments.plane.has_value())
    throw UsageError("grid needs either --object NAME or --plane z=Z");
  if (arguments.solve) return;
  for (const char* name : {"--photometric", "--json", "--report", "--restart"})
    if (IsGiven(arguments.scene, name))
      throw UsageError(
          fmt::format("{} is of the light, and without --solve there are only points; give both", name));
  if (arguments.DrawsPicture() || arguments.WritesPage())
    throw UsageError(fmt::format("-o '{}' shows the light; give --solve, too", *arguments.output));
}

// The points of the grid that light can reach, and how many it cannot.
struct ReachedGrid {
  WorkGrid grid;
  std::size_t left_out = 0;
};

ReachedGrid FindGrid(const GridArguments& arguments, const Scene& scene) {
  ReachedGrid found;
  try {
    if (arguments.object) {
      const std::vector<std::int32_t> faces = FacesNamed(scene, arguments.scene.scene, *arguments.object);
      found.grid = GridOverFaces(scene, faces, arguments.height, arguments.spacing);
    } else {
      found.grid = GridAtHeight(scene, *arguments.plane + arguments.height, arguments.spacing);
    }
  } catch (const InputError& error) {
    const std::string why = error.what();
    if (why.starts_with(arguments.scene.scene + ":")) throw;
    throw InputError(fmt::format("{}: error: {}{}", arguments.scene.scene,
                                 arguments.object ? fmt::format("`{}`: ", *arguments.object) : "", why));
  }
  std::vector<GridPoint>& points = found.grid.points;
  const Surroundings surroundings(scene);
  std::vector<char> is_hidden(points.size());
  ParallelFor(points.size(), 64, [&](std::size_t i) {
    is_hidden[i] = surroundings.SeesOnlyBacks(points[i].position, Vec3::UnitZ());
  });
  const std::size_t all = points.size();
  std::size_t i = 0;
  std::erase_if(points, [&](const GridPoint&) { return is_hidden[i++] != 0; });
  found.left_out = all - points.size();
  return found;
}

// The irradiance at the points from the solution.
std::vector<Rgb> LightAt(const std::vector<GridPoint>& points, const Scene& scene, const Pipeline& pipeline,
                         const PointIrradianceOptions& how) {
  const PointIrradiance irradiance(pipeline.solution(), pipeline.visibility(), how);
  const Prober prober(scene, irradiance, &pipeline, /*parts=*/false);
  std::vector<ProbePoint> probes;
  for (const GridPoint& point : points) probes.push_back({point.position, Vec3::UnitZ()});
  std::vector<Measurement> measurements;
  RunInterruptible([&](const ExecutionContext& context) { measurements = prober.Measure(probes, context); });
  CheckMeasurements(measurements);
  std::vector<Rgb> light;
  for (const Measurement& measurement : measurements) light.push_back(measurement.exact);
  return light;
}

// A row for each point; `light` is empty where nothing was solved.
std::string GridCsv(const std::vector<GridPoint>& points, const std::vector<Rgb>& light, LightUnit unit) {
  fmt::memory_buffer csv;
  const std::string_view columns = light.empty()             ? ""
                                   : unit == LightUnit::kLux ? ",exact_lux"
                                                             : ",exact_r,exact_g,exact_b";
  fmt::format_to(std::back_inserter(csv), "x,y,z,nx,ny,nz{}\n", columns);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i].position;
    fmt::format_to(std::back_inserter(csv), "{:.17g},{:.17g},{:.17g},0,0,1", p.x(), p.y(), p.z());
    if (!light.empty() && unit == LightUnit::kLux)
      fmt::format_to(std::back_inserter(csv), ",{:.17g}", Lux(light[i]));
    else if (!light.empty())
      fmt::format_to(std::back_inserter(csv), ",{:.17g},{:.17g},{:.17g}", light[i][0], light[i][1],
                     light[i][2]);
    csv.push_back('\n');
  }
  return fmt::to_string(csv);
}

std::string GridTitle(const GridArguments& arguments) {
  return fmt::format("{} of {}, {}",
                     arguments.unit == LightUnit::kLux ? "Illuminance" : "Mean irradiance of the channels",
                     arguments.scene.scene,
                     arguments.object ? fmt::format("{:g} m over {}", arguments.height, *arguments.object)
                                      : fmt::format("z = {:g} m", *arguments.plane + arguments.height));
}

// The light in lux, or the mean of its channels in W/m^2.
std::string GridPicture(const GridArguments& arguments, const WorkGrid& grid, const std::vector<Rgb>& light) {
  const bool in_lux = arguments.unit == LightUnit::kLux;
  ValueMap map;
  map.grid.columns = grid.columns;
  map.grid.rows = grid.rows;
  map.grid.values.assign(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows),
                         std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < light.size(); ++i) {
    const GridPoint& at = grid.points[i];
    map.grid.values[static_cast<std::size_t>(at.row) * static_cast<std::size_t>(grid.columns) +
                    static_cast<std::size_t>(at.column)] = in_lux ? Lux(light[i]) : light[i].mean();
  }
  map.first = grid.first;
  map.spacing = grid.spacing;
  map.title = GridTitle(arguments);
  map.unit = in_lux ? "lux" : "W/m\u00b2";
  return ValueMapSvg(map);
}

// The contents of the output file.
std::string GridFile(const GridArguments& arguments, const ReachedGrid& found, const std::vector<Rgb>& light,
                     const Pipeline& pipeline) {
  if (arguments.DrawsPicture()) return GridPicture(arguments, found.grid, light);
  if (!arguments.WritesPage()) return GridCsv(found.grid.points, light, arguments.unit);
  return RoomPageHtml({pipeline.scene(), pipeline.report(), light, found.left_out, arguments.unit,
                       GridTitle(arguments), GridPicture(arguments, found.grid, light)});
}

void WriteLight(const GridArguments& arguments, const ReachedGrid& found, const std::vector<Rgb>& light,
                const Pipeline& pipeline) {
  const std::string statistics = arguments.as_json
                                     ? StatisticsJson(light, arguments.unit, found.left_out).dump(2) + "\n"
                                     : StatisticsText(light, arguments.unit, found.left_out);
  if (!arguments.output) {
    WriteResult(std::nullopt, GridCsv(found.grid.points, light, arguments.unit));
    return PrintText(statistics);
  }
  WriteResult(arguments.output, GridFile(arguments, found, light, pipeline));
  WriteResult(std::nullopt, statistics);
}

nlohmann::ordered_json GridOptions(const GridArguments& arguments) {
  nlohmann::ordered_json options;
  if (arguments.object) options["object"] = *arguments.object;
  if (arguments.plane) options["plane"] = fmt::format("z={}", *arguments.plane);
  options["height"] = arguments.height;
  options["spacing"] = arguments.spacing;
  options["solve"] = arguments.solve;
  options["photometric"] = arguments.unit == LightUnit::kLux;
  return options;
}

void Grid(GridArguments arguments) {
  CheckGrid(arguments);
  arguments.scene.lit = arguments.solve;
  arguments.scene.outputs.Add("-o", arguments.output);
  arguments.scene.outputs.Add("--report", arguments.scene.report);
  LoadedScene loaded = LoadToSolve(arguments.scene);
  const ReachedGrid found = FindGrid(arguments, loaded.scene);
  if (!arguments.solve) {
    if (arguments.scene.verbose) {
      nlohmann::ordered_json options = OptionsUsed(arguments.scene, nullptr);
      options.update(GridOptions(arguments));
      PrintOptionsUsed(options);
    }
    if (found.left_out > 0)
      Say(fmt::format("note: {} points inside solids or behind faces are left out", found.left_out));
    return WriteResult(arguments.output, GridCsv(found.grid.points, {}, arguments.unit));
  }
  if (found.grid.points.empty())
    throw InputError(
        fmt::format("{}: error: no light reaches a point of the grid: all {} lie inside solids or behind "
                    "faces; give another --height or --plane",
                    arguments.scene.scene, found.left_out));
  const PointIrradianceOptions how =
      loaded.stored ? loaded.stored->solving.point : arguments.scene.solving.point;
  SolveRun run(arguments.scene, loaded, GridOptions(arguments));
  run.Run(MeshKind::kInterpolant, WantsReport(arguments.scene) || arguments.WritesPage());
  const std::vector<Rgb> light = LightAt(found.grid.points, loaded.scene, run.pipeline(), how);
  run.Tell();
  WriteLight(arguments, found, light, run.pipeline());
}

// The option --plane z=Z.
void AddPlane(CLI::App& app, std::optional<double>* plane) {
  app.add_option_function<std::string>(
         "--plane",
         [plane](const std::string& text) {
           const std::optional<double> z =
               text.starts_with("z=") ? ParseNumber(std::string_view(text).substr(2)) : std::nullopt;
           if (!z || !kHeight.holds(*z))
             throw CLI::ValidationError("--plane", fmt::format("'{}' is not z=Z, Z {}", text, kHeight.words));
           *plane = *z;
         },
         "A horizontal plane [m], over the extent of the scene")
      ->type_name("z=Z");
}

void AddOutput(CLI::App& app, GridArguments* arguments) {
  app.add_option_function<std::string>(
         "-o,--output",
         [arguments](const std::string& path) {
           const std::string ending = EndingOf(path);
           if (ending != kPointsEnding && ending != kPictureEnding && ending != kPageEnding)
             throw CLI::ValidationError("-o",
                                        EndingError(path, {kPointsEnding, kPictureEnding, kPageEnding}));
           arguments->output = path;
         },
         "The points, with --solve and their light, as .csv (default: standard output), or a picture of the "
         "light with contour lines and a scale, as .svg, or a page with the picture, the error, luminaires "
         "and "
         "materials, as .html")
      ->type_name("FILE");
}

}  // namespace

Command AddGridCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("grid", "Make a grid of points on a working plane, and tell the light there");
  const auto arguments = std::make_shared<GridArguments>();
  AddSceneArguments(*app, &arguments->scene);
  app->add_option("--object", arguments->object,
                  "An object, a group or a face's number: points over its faces that look up")
      ->type_name("NAME");
  AddPlane(*app, &arguments->plane);
  AddNumber(*app, "--height", &arguments->height, kHeight, "Of the points above the object or the plane [m]");
  AddNumber(*app, "--spacing", &arguments->spacing, kSpacing,
            "Between neighbouring points along x and y [m]");
  app->add_flag("--solve", arguments->solve,
                "Solve for the light, and tell it at the points: mean, minimum, maximum, "
                "U0 = minimum / mean and Ud = minimum / maximum");
  AddPhotometricOption(*app, &arguments->unit);
  app->add_flag("--json", arguments->as_json, "Tell them as JSON");
  AddOutput(*app, arguments.get());
  AddSolveOptions(*app, &arguments->scene);
  AddRestartOption(*app, &arguments->scene);
  AddReportOption(*app, &arguments->scene);
  app->footer(
      "Writes x,y,z,nx,ny,nz, which `probe --points -` reads, and with --solve exact_r,exact_g,exact_b "
      "[W/m^2] or\n"
      "exact_lux: the irradiance from the whole scene on a plane that looks up. As many points as fit at "
      "the\n"
      "spacing, centred. Points inside solids or behind faces are left out. Mean, minimum and so on go to "
      "standard\n"
      "output where -o is given, else to standard error.");
  return {app, [arguments] { Grid(*arguments); }};
}

}  // namespace penumbra
