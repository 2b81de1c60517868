// The settings of the viewer.

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <variant>

#include "display/viewer/viewer.h"
#include "mesh/pipeline/option_table.h"
#include "mesh/pipeline/solver_choice.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"

namespace penumbra::viewer {
namespace {

constexpr std::uint64_t kMostThreads = 1024;  // as --threads

// What leaves an option out, which then follows from others.
bool LeavesOut(const SolveOption& option, const std::string& text) {
  return option.field.optional &&
         (text == "auto" || (text == "none" && option.field.kind != OptionKind::kChoice));
}

// What a panel shows of an option that is left out.
std::string LeftOutText(const SolveOption& option, const Scene& scene, const PipelineOptions& solving) {
  if (option.field.kind == OptionKind::kChoice) return "auto";
  if (!option.resolved) return "none";
  return fmt::format("auto ({:.4g})", std::get<double>(option.resolved(Resolve(scene, solving))));
}

// The setting of an option, as far as the table says it.
Setting SettingOf(const SolveOption& option) {
  Setting setting;
  setting.name = SettingName(option);
  const bool for_studies = option.group == OptionGroup::kStudies;
  setting.group = GroupTitle(for_studies ? OptionGroup::kStudies : OptionGroup::kSolving);
  setting.help = *option.unit ? fmt::format("{} [{}]", option.label, option.unit) : option.label;
  const OptionField& field = option.field;
  switch (field.kind) {
    case OptionKind::kFlag:
      setting.choices = field.choices();
      setting.kind = setting.choices[1] == "on" ? SettingKind::kToggle : SettingKind::kChoice;
      break;
    case OptionKind::kInteger:
      setting.kind = SettingKind::kInteger;
      break;
    case OptionKind::kNumber:
      setting.kind = SettingKind::kNumber;
      setting.low = field.numbers.low;
      setting.high = field.numbers.high;
      setting.logarithmic = field.numbers.low > 0 && !field.numbers.or_zero;
      setting.automatic = field.optional;
      break;
    case OptionKind::kChoice:
      setting.kind = SettingKind::kChoice;
      setting.choices = field.choices();
      if (field.optional) setting.choices.insert(setting.choices.begin(), "auto");
      break;
  }
  return setting;
}

std::uint64_t WholeNumber(const std::string& text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || text.empty())
    throw InputError(fmt::format("'{}' is not a whole number", text));
  return number;
}

}  // namespace

void Viewer::AddViewSettings() {
  Settings& s = settings_;
  s.Choice("mode", "Drawing", "Drawing mode", &view_.mode,
           {{"flat", DrawMode::kFlat},
            {"gouraud", DrawMode::kGouraud},
            {"gouraud-mesh", DrawMode::kGouraudMesh},
            {"interpolant", DrawMode::kInterpolant},
            {"exact", DrawMode::kExact},
            {"lerp", DrawMode::kLerp},
            {"rho", DrawMode::kRho}});
  s.Choice("backend", "Drawing", "Who draws the two passes", &view_.backend,
           {{"software", Backend::kSoftware}, {"opengl", Backend::kOpenGl}});
  s.Choice("opengl-coordinates", "Drawing", "Coordinates by OpenGL", &view_.coordinates,
           {{"float", OpenGlCoordinates::kFloat}, {"8bit", OpenGlCoordinates::kTexture}});
  s.Toggle("faces", "Drawing", "Faces", &view_.faces);
  s.Toggle("trees-by-reflectance", "Drawing", "Flat faces by reflectance", &view_.trees_by_reflectance);
  s.Toggle("split", "Drawing", "Ids, coordinates, depth and picture", &view_.split);
  s.Integer("supersampling", "Drawing", "Saved pictures: samples a side", &view_.supersampling, 1, 8);
  s.Toggle("auto-exposure", "Exposure", "Automatic exposure", &view_.auto_exposure);
  Setting& exposure =
      s.Number("exposure", "Exposure", "Irradiance-2-Pixel [m^2/W]", &view_.exposure, 1e-9, 1e9, true);
  exposure.get = [this] { return TextOf(view_.auto_exposure ? picture_.exposure() : view_.exposure); };
  exposure.set = [this](const std::string& text) {
    view_.exposure = NumberFrom(text, 1e-9, 1e9);
    view_.auto_exposure = false;
  };
  s.Toggle("false-colour", "Exposure", "False colours", &view_.false_colour);
  s.Number("false-colour-max", "Exposure", "Top of the scale [W/m^2], 0: by exposure",
           &view_.false_colour_max, 0, 1e12, false);

  OverlaySettings& o = view_.overlays;
  s.Toggle("element-mesh", "Visualisations", "Element mesh", &o.element_mesh);
  s.Integer("mesh-depth", "Visualisations", "Mesh depth", &o.mesh_depth, 0, kMaxLevel);
  s.Toggle("discontinuities", "Visualisations", "All discontinuities", &o.discontinuities);
  s.Toggle("triangles", "Visualisations", "Triangulation", &o.triangles);
  s.Toggle("sample-points", "Visualisations", "Sample points", &o.sample_points);
  s.Toggle("hidden-lines", "Visualisations", "Show hidden lines", &o.hidden_lines);
  s.Toggle("isolate", "Visualisations", "Draw only what is selected", &view_.isolate);
  s.Toggle("visible-links", "Links", "Visible links", &o.visible_links);
  s.Toggle("split-links", "Links", "Links split by a plane", &o.split_links);
  s.Toggle("partial-links", "Links", "Partial links", &o.partial_links);
  s.Number("link-min-irradiance", "Links", "At least [W/m^2]", &o.link_min_irradiance, 0, 1e12, false);
  s.Integer("link-limit", "Links", "The strongest", &o.link_limit, 0, 1'000'000);
  s.Toggle("error-map", "Graphs", "Representation error as a map", &view_.error_map);
  s.Number("error-map-max", "Graphs", "Top of the map, relative", &view_.error_map_max, 1e-9, 1e9, true);
  s.Toggle("analytic-graph", "Graphs", "Analytic irradiance", &o.analytic_graph);
  s.Toggle("interpolated-graph", "Graphs", "Interpolated irradiance", &o.interpolated_graph);
  s.Toggle("error-graph", "Graphs", "Error surface", &o.error_graph);
  s.Number("graph-scale", "Graphs", "Graph height scale [m per W/m^2]", &o.graph_scale, 1e-9, 1e6, true);
  s.Integer("grid-density", "Graphs", "Grid density", &o.grid_density, 1, 200);
  s.Toggle("dynamic-grid", "Graphs", "Dynamic grid density", &o.dynamic_grid);

  s.Choice("navigation", "Viewing", "Viewing mode", &view_.navigation,
           {{"arcball", Navigation::kArcball}, {"walk", Navigation::kWalk}});
  s.Number("walk-speed", "Viewing", "Walking speed [m/s]", &view_.walk_speed, 1e-3, 1e4, true);
  s.Toggle("mouse-look", "Viewing", "The mouse turns a walking view", &view_.mouse_look);
  s.Vector(
      "eye", "Viewing", "Eye [m]", [this] { return view_.camera.eye; },
      [this](const Vec3& v) {
        Camera camera = view_.camera;
        camera.eye = v;
        GoTo(camera);
      });
  s.Vector(
      "look-at", "Viewing", "Look at [m]", [this] { return view_.camera.look_at; },
      [this](const Vec3& v) {
        Camera camera = view_.camera;
        camera.look_at = v;
        GoTo(camera);
      });
  s.Vector(
      "up", "Viewing", "Up", [this] { return view_.camera.up; },
      [this](const Vec3& v) { view_.camera.up = v; });
  s.Number("fov", "Viewing", "Vertical field of view [degrees]", &view_.camera.vertical_fov, kMinFov, kMaxFov,
           false);

  s.Toggle("control-panel", "Panels", "Drawing control panel", &panels_.control);
  s.Toggle("parameters", "Panels", "Parameters", &panels_.parameters);
  s.Toggle("report", "Panels", "Report", &panels_.report);
  s.Toggle("details", "Panels", "Details", &panels_.details);
  s.Toggle("help", "Panels", "Keyboard shortcuts", &panels_.help);
}

void Viewer::AddSolveSettings() {
  FindOption("solver")->field.set(OptionValue(std::string(kDenseSolver)), &dense_);
  const auto add = [this](auto wanted) {
    for (const SolveOption& option : OptionTable())
      if (wanted(option.group)) AddSolveSetting(option);
  };
  add([](OptionGroup group) { return group != OptionGroup::kRunning && group != OptionGroup::kStudies; });
  add([](OptionGroup group) { return group == OptionGroup::kRunning; });
  // No part of the solution: whatever comes next is done by so many, and what there is stays.
  Setting threads;
  threads.name = "threads";
  threads.group = GroupTitle(OptionGroup::kSolving);
  threads.help = "Threads, 0: all";
  threads.get = [] { return std::to_string(ThreadCount()); };
  threads.set = [](const std::string& text) {
    const std::uint64_t count = WholeNumber(text);
    if (count > kMostThreads) throw InputError(fmt::format("'{}' are too many", text));
    SetThreadCount(static_cast<int>(count));
  };
  settings_.Add(threads);
  add([](OptionGroup group) { return group == OptionGroup::kStudies; });
}

void Viewer::AddSolveSetting(const SolveOption& option) {
  Setting setting = SettingOf(option);
  setting.get = [this, &option] {
    const std::optional<OptionValue> value = option.field.get(HolderOf(option));
    return value ? ValueText(option.field, *value) : LeftOutText(option, *snapshot_->scene, options_.solving);
  };
  setting.set = [this, &option](const std::string& text) {
    std::optional<OptionValue> value;
    if (!LeavesOut(option, text)) value = ParseValue(option.field, text);
    const PipelineOptions before = options_.solving;
    option.field.set(value, &HolderOf(option));
    if (SolverOf(before) != SolverOf(options_.solving)) KeepSolverOptions(before);
    if (option.measures_only)
      session_.SetErrorPoints(options_.solving.error_points);
    else
      SolvingChanged();
  };
  settings_.Add(std::move(setting));
}

// PipelineOptions has no place for some options of the dense solver while that is not chosen. Then `dense_`
// holds them.
PipelineOptions& Viewer::HolderOf(const SolveOption& option) {
  const bool has_place = option.field.optional || option.field.get(options_.solving);
  return has_place ? options_.solving : dense_;
}

// After another solver was chosen than `before`: `dense_` keeps what has no place any more, and gives back
// what has one again.
void Viewer::KeepSolverOptions(const PipelineOptions& before) {
  PipelineOptions& now = options_.solving;
  for (const SolveOption& option : OptionTable()) {
    const std::optional<OptionValue> had = option.field.get(before), has = option.field.get(now);
    if (option.field.optional || had.has_value() == has.has_value()) continue;
    if (had)
      option.field.set(had, &dense_);
    else
      option.field.set(option.field.get(dense_), &now);
  }
}

// Settings that are done rather than kept: dialogs and scripts name a file or a camera.
void Viewer::AddFileSettings() {
  const auto action = [this](const std::string& name, const std::string& help, auto run) {
    Setting setting{name, "Files", help, SettingKind::kText, 0, 1, false, false, {}, {}, {}};
    setting.get = [] { return std::string(); };
    setting.set = run;
    settings_.Add(std::move(setting));
  };
  action("open", "Open a scene, a file or the name of a built-in one, or a solution",
         [this](const std::string& v) { Open(v); });
  action("save-solution", "Save the solution",
         [this](const std::string& v) { SaveSolved(v, options_.files.save_solution); });
  action("save-report", "Save the report, as JSON",
         [this](const std::string& v) { SaveSolved(v, options_.files.save_report); });
  action("export", "Export as .vtu, .ply, .glb, .obj, .pbrt or .mgf",
         [this](const std::string& v) { Export(v); });
  action("save-picture", "Save the picture as .png, or .exr in W/m^2",
         [this](const std::string& v) { SavePicture(v); });
  action("save-camera", "Name this camera", [this](const std::string& v) { SaveCamera(v); });
  action("camera", "Go to a camera", [this](const std::string& v) {
    for (const Camera& camera : cameras_)
      if (camera.name == v) {
        GoTo(camera);
        return;
      }
    std::string names;
    for (const Camera& camera : cameras_) names += (names.empty() ? "" : ", ") + camera.name;
    throw InputError(fmt::format("there is no camera '{}'; there are {}", v, names.empty() ? "none" : names));
  });
}

}  // namespace penumbra::viewer
