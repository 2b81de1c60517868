// The settings of the viewer.

#include <fmt/format.h>

#include <charconv>
#include <utility>
#include <variant>

#include "display/image_writers.h"
#include "display/mesh_writers.h"
#include "display/viewer/overlays.h"
#include "display/viewer/viewer.h"
#include "mesh/pipeline/option_table.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/parallel.h"
#include "solver/scene/scene_writers.h"

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

std::string ExportHelp() {
  std::vector<std::string> endings = Dotted(MeshWriters().Names());
  for (const std::string& ending : Dotted(SceneWriters().Names())) endings.push_back(ending);
  const std::string last = endings.back();
  endings.pop_back();
  return fmt::format("Export as {} or {}", fmt::join(endings, ", "), last);
}

std::string PictureHelp() {
  std::vector<std::string> formats;
  for (const ImageWriterRegistry::Method& format : ImageWriters().methods())
    formats.push_back(fmt::format(".{}{}", format.name, format.make()->IsLinear() ? " in W/m^2" : ""));
  return fmt::format("Save the picture as {}", fmt::join(formats, ", or "));
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
            {"rho", DrawMode::kRho},
            {"nodal", DrawMode::kNodal},
            {"gouraud-screen", DrawMode::kGouraudScreen},
            {"bilinear", DrawMode::kBilinear},
            {"bicubic", DrawMode::kBicubic}});
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
      s.Number("exposure", "Exposure", "Irradiance-2-Pixel [m^2/W]", &view_.exposure, {1e-9, 1e9, true});
  exposure.get = [this] { return TextOf(view_.auto_exposure ? picture_.exposure() : view_.exposure); };
  exposure.set = [this](const std::string& text) {
    view_.exposure = NumberFrom(text, 1e-9, 1e9);
    view_.auto_exposure = false;
  };
  s.Toggle("false-colour", "Exposure", "False colours", &view_.false_colour);
  s.Number("false-colour-max", "Exposure", "Top of the scale, 0: by what is seen", &view_.false_colour_max,
           {0, 1e12});
  s.Toggle("false-colour-log", "Exposure", "Logarithmic scale, three decades", &view_.false_colour_log);
  s.Choice("unit", "Exposure", "Unit of light", &view_.unit,
           {{"watts", LightUnit::kWatts}, {"lux", LightUnit::kLux}});

  AddVisualisationSettings();
  AddViewingSettings();
}

void Viewer::AddVisualisationSettings() {
  Settings& s = settings_;
  OverlaySettings& o = view_.overlays;
  AddOverlaySettings("Visualisations", &o, &s);
  s.Toggle("hidden-lines", "Visualisations", "Show hidden lines", &o.hidden_lines);
  s.Toggle("compare", "Visualisations", "What was kept, left of a border", &compares_);
  s.Number("compare-at", "Visualisations", "The border", &compare_at_, {0, 1});
  s.Toggle("isolate", "Visualisations", "Draw only what is selected", &view_.isolate);
  AddPartSettings();
  AddOverlaySettings("Links", &o, &s);
  s.Toggle("error-map", "Graphs", "Representation error as a map", &view_.error_map);
  s.Number("error-map-max", "Graphs", "Top of the map, relative", &view_.error_map_max, {1e-9, 1e9, true});
  AddOverlaySettings("Graphs", &o, &s);
  Setting line{"line", "Graphs", "Line of the plot, x,y,z x,y,z", SettingKind::kText, 0, 1, false, false, {},
               {},     {}};
  line.get = [this] { return TextOf(view_.line); };
  line.set = [this](const std::string& text) {
    view_.line = ParseLine(*snapshot_->scene, text);
    line_start_.reset();
    draws_line_ = false;
  };
  s.Add(std::move(line));
}

void Viewer::AddViewingSettings() {
  Settings& s = settings_;
  s.Choice("navigation", "Viewing", "Viewing mode", &view_.navigation,
           {{"arcball", Navigation::kArcball}, {"walk", Navigation::kWalk}});
  s.Number("walk-speed", "Viewing", "Walking speed [m/s]", &view_.walk_speed, {1e-3, 1e4, true});
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
  s.Number("fov", "Viewing", "Vertical field of view [degrees]", &view_.camera.vertical_fov,
           {kMinFov, kMaxFov});

  s.Toggle("control-panel", "Panels", "Drawing control panel", &panels_.control);
  s.Toggle("parameters", "Panels", "Parameters", &panels_.parameters);
  s.Toggle("lamps", "Panels", "Lamps and materials", &panels_.lamps);
  s.Toggle("outline", "Panels", "Objects, materials and faces", &panels_.outline);
  s.Toggle("time-line", "Panels", "Time line", &panels_.steps);
  s.Toggle("report", "Panels", "Report", &panels_.report);
  s.Toggle("details", "Panels", "Details", &panels_.details);
  s.Toggle("hover", "Panels", "What is under the pointer", &panels_.hover);
  s.Toggle("help", "Panels", "Keyboard shortcuts", &panels_.help);
  s.Number("ask-above", "Panels", "Ask before so much unsaved work is lost [s]", &ask_above_, {0, 1e9});
}

void Viewer::AddSolveSettings() {
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
    const std::optional<OptionValue> value = option.field.get(options_.solving);
    return value ? ValueText(option.field, *value) : LeftOutText(option, *snapshot_->scene, options_.solving);
  };
  setting.set = [this, &option](const std::string& text) {
    std::optional<OptionValue> value;
    if (!LeavesOut(option, text)) value = ParseValue(option.field, text);
    option.field.set(value, &options_.solving);
    if (option.measures_only)
      session_.SetErrorPoints(options_.solving.error_points);
    else
      SolvingChanged();
  };
  settings_.Add(std::move(setting));
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
  action("export", ExportHelp(), [this](const std::string& v) { Export(v); });
  action("save-picture", PictureHelp(), [this](const std::string& v) { SavePicture(v); });
  action("save-line", "Save the light over the line as CSV", [this](const std::string& v) { SaveLine(v); });
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
