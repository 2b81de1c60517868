// penumbra info: what is in a scene, and what was repaired in it.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/face_list.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/report.h"
#include "apps/restart.h"
#include "apps/scene_arguments.h"
#include "apps/solve_options.h"
#include "apps/solve_run.h"
#include "display/photometry.h"
#include "mesh/pipeline/solution_file.h"
#include "solver/scene/plane_overlaps.h"

namespace penumbra {
namespace {

using Json = nlohmann::ordered_json;

struct SceneSummary {
  std::size_t dropped = 0, triangles = 0, quadrilaterals = 0, emitters = 0;
  double area = 0;                  // [m^2]
  Rgb emitted_power = Rgb::Zero();  // [W]
};

SceneSummary Summarise(const Scene& scene) {
  SceneSummary summary;
  summary.dropped = static_cast<std::size_t>(std::count_if(scene.faces.begin(), scene.faces.end(),
                                                           [](const Face& f) { return f.vertices.empty(); }));
  for (const Patch& patch : scene.patches) {
    const Rgb& emittance = scene.materials[static_cast<std::size_t>(patch.material)].emittance;
    ++(patch.size == 3 ? summary.triangles : summary.quadrilaterals);
    if ((emittance > 0).any()) ++summary.emitters;
    summary.area += patch.area;
    summary.emitted_power += patch.area * emittance;
  }
  return summary;
}

Json ToJson(const Eigen::Ref<const Vec3>& v) { return {v.x(), v.y(), v.z()}; }

// What a solution file holds: rows of its tables, how it was solved, what came out.
Json SolutionJson(const StoredSolve& stored) {
  const PipelineState& state = stored.state;
  return {{"version", stored.version},
          {"schema", stored.schema},
          {"tables",
           {{"visible_pairs", state.visibility.rows().pairs.size()},
            {"elements", state.solution.forest.size()},
            {"links", state.solution.links.links.size()},
            {"link_blockers", state.solution.links.blockers.size()},
            {"fragments", state.solution.fragments.size()},
            {"mesh_positions", state.mesh.positions.size()},
            {"mesh_triangles", state.mesh.triangles.size()},
            {"emitters", state.emitters.size()}}},
          {"triangles", TriangleQualityJson(state.report.quality)},
          {"options", stored.options},
          {"report", Json::parse(LastingReportJson(state.report))}};
}

// The objects and groups, with the numbers of their faces.
Json ObjectsJson(const Scene& scene) {
  Json objects = Json::array();
  for (const Object& object : scene.objects)
    objects.push_back(
        {{"name", object.name}, {"faces", object.faces.size()}, {"face_numbers", object.faces}});
  return objects;
}

Json MaterialsJson(const Scene& scene) {
  std::vector<std::size_t> faces(scene.materials.size());
  for (const Face& face : scene.faces) ++faces[static_cast<std::size_t>(face.material)];
  Json materials = Json::array();
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    materials.push_back({{"name", scene.materials[i].name},
                         {"reflectance", ToJson(scene.materials[i].reflectance.matrix())},
                         {"emittance", ToJson(scene.materials[i].emittance.matrix())},
                         {"faces", faces[i]}});
  return materials;
}

std::string InfoJson(const LoadedScene& loaded, const SceneSummary& summary, bool with_faces) {
  const Scene& scene = loaded.scene;
  const auto [low, high] = scene.Bounds();
  Json cameras = Json::array();
  for (const Camera& camera : scene.cameras)
    cameras.push_back({{"name", camera.name},
                       {"eye", ToJson(camera.eye)},
                       {"look_at", ToJson(camera.look_at)},
                       {"up", ToJson(camera.up)},
                       {"fov", camera.vertical_fov}});
  Json info = {{"name", scene.name},
               {"faces", scene.faces.size()},
               {"dropped", summary.dropped},
               {"patches", scene.patches.size()},
               {"triangles", summary.triangles},
               {"quadrilaterals", summary.quadrilaterals},
               {"emitters", summary.emitters},
               {"materials", MaterialsJson(scene)},
               {"objects", ObjectsJson(scene)},
               {"bounds", {{"min", ToJson(low)}, {"max", ToJson(high)}}},
               {"area", summary.area},
               {"emitted_power", ToJson(summary.emitted_power.matrix())},
               {"emitted_lumens", Lux(summary.emitted_power)},
               {"cameras", cameras},
               {"warnings", scene.warnings},
               {"face_list", FaceListJson(scene, with_faces)}};
  if (loaded.stored) {
    info["solution"] = SolutionJson(*loaded.stored);
  } else {
    info["coordinate_step"] = ToJson(scene.coordinate_step);
    info["plane_tolerance"] = LargestPlaneDistance(scene);
  }
  return info.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

// "2: floor and lamp".
std::string CountedNames(const auto& named) {
  std::vector<std::string> names;
  for (const auto& one : named) names.push_back(one.name);
  return names.empty() ? "0" : fmt::format("{}: {}", names.size(), NameList(names));
}

std::string InfoText(const LoadedScene& loaded, const SceneSummary& summary) {
  const Scene& scene = loaded.scene;
  const auto [low, high] = scene.Bounds();
  std::string text;
  const auto add = [&](const char* what, const std::string& value) {
    text += fmt::format("{:<14} {}\n", what, value);
  };
  add("scene", scene.name);
  add("faces", fmt::format("{}, {} of them dropped", scene.faces.size(), summary.dropped));
  add("patches", fmt::format("{}: {} triangles, {} quadrilaterals", scene.patches.size(), summary.triangles,
                             summary.quadrilaterals));
  add("emitters", fmt::format("{}", summary.emitters));
  add("materials", CountedNames(scene.materials));
  add("objects", CountedNames(scene.objects));
  add("bounds [m]", fmt::format("{:g},{:g},{:g} to {:g},{:g},{:g}", low.x(), low.y(), low.z(), high.x(),
                                high.y(), high.z()));
  add("area [m^2]", fmt::format("{:g}", summary.area));
  if (!loaded.stored)
    add("one plane [m]", fmt::format("faces up to {:.2g} apart, by the digits of their coordinates",
                                     LargestPlaneDistance(scene)));
  add("emitted [W]", fmt::format("red {:g}, green {:g}, blue {:g}", summary.emitted_power[0],
                                 summary.emitted_power[1], summary.emitted_power[2]));
  add("emitted [lm]", fmt::format("{:g}", Lux(summary.emitted_power)));
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    add(i == 0 ? "cameras" : "", fmt::format("{} {}", i, scene.cameras[i].name));
  add("warnings", fmt::format("{}", scene.warnings.size()));
  if (loaded.stored) {
    const Json solution = SolutionJson(*loaded.stored);
    add("solved by", fmt::format("penumbra {}, schema {}", loaded.stored->version, loaded.stored->schema));
    for (const auto& [name, rows] : solution["tables"].items())
      add(name == "visible_pairs" ? "tables" : "", fmt::format("{} {}", name, rows.get<std::size_t>()));
    const PipelineReport& report = loaded.stored->state.report;
    add("shapes", TriangleQualityText(report.quality));
    add("error", fmt::format("interpolants: p99 {:.3g}; solution, estimated: {:.3g}; asked for {:.3g}: {}",
                             report.interpolant_error.p99, report.solution_error_estimate, report.error_asked,
                             report.error_met ? "met" : "not met"));
  }
  return text;
}

struct InfoFormat {
  bool as_json = false;     // JSON instead of text
  bool with_faces = false;  // also the faces with their corners
};

void Info(SceneArguments arguments, const InfoFormat& format) {
  LoadedScene loaded = LoadToSolve(arguments);
  const SceneSummary summary = Summarise(loaded.scene);
  std::string info =
      format.as_json ? InfoJson(loaded, summary, format.with_faces) : InfoText(loaded, summary);
  if (format.with_faces && !format.as_json) info += FaceListText(loaded.scene);
  if (arguments.report) {
    SolveRun run(arguments, loaded);
    run.Run(MeshKind::kInterpolant, true);
    run.Tell();
  } else if (arguments.verbose) {
    PrintOptionsUsed(loaded.stored ? loaded.stored->options : OptionsUsed(arguments, nullptr));
  }
  WriteResult(std::nullopt, info);
}

void InfoOfAll(SceneArguments arguments, const InfoFormat& format) {
  RefuseForSeveralScenes(arguments, "--report", arguments.report);
  arguments.outputs.Add("--report", arguments.report);
  for (const std::string& scene : arguments.scenes) {
    arguments.scene = scene;
    Info(arguments, format);
  }
}

}  // namespace

Command AddInfoCommand(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("info", "Tell what is in a scene or a solution, and what was repaired in it");
  const auto arguments = std::make_shared<SceneArguments>();
  const auto format = std::make_shared<InfoFormat>();
  AddSeveralScenesArguments(*app, arguments.get());
  app->add_flag("--json", format->as_json, "Print JSON");
  app->add_flag("--faces", format->with_faces,
                "Also print each face: object, material, area, centroid, normal, corners");
  AddSolveOptions(*app, arguments.get());
  AddRestartOption(*app, arguments.get());
  AddReportOption(*app, arguments.get());
  app->footer(
      "Nothing of a scene is solved, and the options of solving change nothing, unless --report asks what a "
      "solve of\n"
      "the scene takes and reaches. The report of a solution is that of the solve that made it.");
  return {app, [arguments, format] { InfoOfAll(*arguments, *format); }};
}

}  // namespace penumbra
