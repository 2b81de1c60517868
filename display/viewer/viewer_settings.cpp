// The settings of the viewer.

#include <fmt/format.h>

#include <charconv>

#include "display/image_writers.h"
#include "display/mesh_writers.h"
#include "display/viewer/overlays.h"
#include "display/viewer/viewer.h"
#include "mesh/discontinuities/discontinuity_choices.h"
#include "solver/base/check.h"
#include "solver/base/file_endings.h"
#include "solver/base/parallel.h"
#include "solver/scene/scene_writers.h"
#include "solver/transport/links/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/light_solvers.h"

namespace penumbra::viewer {
namespace {

constexpr std::uint64_t kMostThreads = 1024;  // as --threads

// A setting of the solver that follows from others unless it is given.
Setting Optional(const std::string& name, const std::string& help, std::optional<double>* value, double low,
                 std::function<double()> otherwise, std::function<void()> changed) {
  constexpr double kHigh = 1e12;
  Setting setting{name, "Solving", help, SettingKind::kNumber, low, kHigh, true, true, {}, {}, {}};
  setting.get = [value, otherwise = std::move(otherwise)] {
    if (*value) return TextOf(**value);
    return otherwise ? fmt::format("auto ({:.4g})", otherwise()) : std::string("none");
  };
  setting.set = [=, changed = std::move(changed)](const std::string& text) {
    *value = text == "auto" || text == "none" ? std::nullopt : std::optional(NumberFrom(text, low, kHigh));
    changed();
  };
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
  AddOverlaySettings("Visualisations", &o, &s);
  s.Toggle("hidden-lines", "Visualisations", "Show hidden lines", &o.hidden_lines);
  s.Toggle("isolate", "Visualisations", "Draw only what is selected", &view_.isolate);
  AddOverlaySettings("Links", &o, &s);
  s.Toggle("error-map", "Graphs", "Representation error as a map", &view_.error_map);
  s.Number("error-map-max", "Graphs", "Top of the map, relative", &view_.error_map_max, 1e-9, 1e9, true);
  AddOverlaySettings("Graphs", &o, &s);

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
  Settings& s = settings_;
  PipelineOptions& o = options_.solving;
  const auto changed = [this] { SolvingChanged(); };
  const auto also = [&](Setting& setting) {
    setting.set = [set = setting.set, changed](const std::string& text) {
      set(text);
      changed();
    };
  };
  also(s.Number("error", "Solving", "Error of what is shown, relative", &o.error, 1e-6, 10, true));
  s.Add(Optional(
      "eps", "Max error of a link [W/m^2]", &o.eps, 1e-12,
      [this] { return Resolve(*snapshot_->scene, options_.solving).solver.eps; }, changed));
  s.Add(Optional(
      "min-area", "Min area of an element [m^2]", &o.min_area, 0,
      [this] { return Resolve(*snapshot_->scene, options_.solving).solver.min_area; }, changed));
  s.Add(Optional(
      "min-discontinuity-weight", "Minimum discontinuity weight [W/m^2]", &o.min_discontinuity_weight, 0,
      [this] { return Resolve(*snapshot_->scene, options_.solving).discontinuities.min_weight; }, changed));
  s.Add(Optional(
      "min-wanted-weight", "Minimum weight that refinement may want [W/m^2]", &o.min_wanted_weight, 0,
      [this] { return Resolve(*snapshot_->scene, options_.solving).discontinuities.min_wanted_weight; },
      changed));
  also(s.Integer("corner-divisions", "Solving", "Divisions towards ends of contacts", &o.corner_divisions, 0,
                 kMostCornerDivisions));
  also(s.Choice("refine", "Solving", "Refine by", &o.refine,
                {{"transport", RefineBy::kTransport},
                 {"representation", RefineBy::kRepresentation},
                 {"both", RefineBy::kBoth}}));
  also(s.NameChoice("mesh-discontinuities", "Solving", "Discontinuities in the mesh", &o.discontinuities,
                    DiscontinuityChoices().Names()));
  also(s.OptionalChoice(
      "weight", "Solving", "Weight of discontinuities", &o.weight,
      {{"thesis", DiscontinuityWeight::kThesis}, {"irradiance", DiscontinuityWeight::kIrradiance}}));
  also(s.Toggle("keep-hidden-discontinuities", "Solving", "Hidden discontinuities, too",
                &o.keep_hidden_discontinuities));
  also(s.Number("eee", "Solving", "Triple-edge discontinuities within [m], 0: none", &o.triple_edge_tolerance,
                0, 1e12, false));
  s.Add(Optional("source-error", "Error of sources cut by corrections, relative", &o.source_error, 1e-9, {},
                 changed));
  also(s.Integer("error-samples", "Solving", "Error samples a side of a triangle", &o.error_samples, 1, 100));
  also(s.Integer("max-leaf-dsets", "Solving", "Max leaf discontinuity segments", &o.max_leaf_dsets, 0,
                 1'000'000));
  s.Add(Optional(
      "relative-cutoff", "Relative error cutoff", &o.relative_cutoff, 1e-15,
      [this] { return Resolve(*snapshot_->scene, options_.solving).solver.relative_cutoff; }, changed));
  also(s.Integer("corrections", "Solving", "Corrections by exact irradiance", &o.max_corrections, 0, 100));
  also(s.Integer("iterations", "Solving", "Most iterations", &o.max_iterations, 1, 1'000'000));
  also(s.Choice("scheme", "Solving", "Sweeps", &o.scheme,
                {{"jacobi", IterationScheme::kJacobi}, {"gauss-seidel", IterationScheme::kGaussSeidel}}));
  also(s.Choice("acceleration", "Solving", "Guess ahead between sweeps", &o.acceleration,
                {{"none", Acceleration::kNone}, {"anderson", Acceleration::kAnderson}}));
  also(s.NameChoice("oracle", "Solving", "Refinement of links", &o.oracle, RefinementOracles().Names()));
  also(s.Toggle("multigrid", "Solving", "Coarse links first", &o.multigrid));
  also(s.NameChoice("form-factors", "Solving", "Form factors of links", &o.form_factors,
                    LinkFormFactorMethods().Names()));
  s.Add(Optional("time-limit", "Time limit [s]", &o.time_limit, 1e-9, {}, changed));
  s.Add(Optional("memory-limit", "Memory limit [bytes]", &o.memory_limit, 1, {}, changed));
  also(s.Integer("bounces", "Solving", "Bounces that are reported", &o.bounces, 0, 1000));
  Setting solver{"solver", "Solving", "Solver", SettingKind::kChoice,   0,
                 1,        false,     false,    LightSolvers().Names(), {},
                 {}};
  solver.get = [&o] { return o.solver; };
  solver.set = [&o, changed](const std::string& text) {
    o.solver = LightSolvers().Find(text).name;
    changed();
  };
  s.Add(solver);
  also(s.Choice("basis", "Solving", "Dense: basis", &o.dense.degree,
                {{"constant", BasisDegree::kConstant},
                 {"linear", BasisDegree::kLinear},
                 {"quadratic", BasisDegree::kQuadratic}}));
  Setting& divisions =
      s.Integer("divisions", "Solving", "Dense: divisions of a patch's side", &o.dense.divisions, 1, 64);
  divisions.set = [set = divisions.set, &o, changed](const std::string& text) {
    const int before = o.dense.divisions;
    set(text);
    if ((o.dense.divisions & (o.dense.divisions - 1)) != 0) {
      o.dense.divisions = before;
      throw InputError(fmt::format("'{}' is not a power of two", text));
    }
    changed();
  };
  also(s.Number("nudge", "Solving", "Nudge of points in contact [m]", &o.point.nudge, 0, 1e6, false));
  also(s.Number("source-push-off", "Solving", "Push-off of sources [m]", &o.point.source_push_off, 0, 1e6,
                false));
  also(s.Number("min-backprojection-segment", "Solving", "Shortest segment of backprojections, 0: clip",
                &o.point.min_backprojection_segment, 0, 1, false));
  Setting points{"error-points",
                 "Solving",
                 "Points that measure the error",
                 SettingKind::kText,
                 0,
                 1,
                 false,
                 false,
                 {},
                 {},
                 {}};
  points.get = [&o] { return std::to_string(o.error_points); };
  points.set = [this, &o](const std::string& text) {
    if (WholeNumber(text) > 100'000'000) throw InputError(fmt::format("'{}' are too many", text));
    o.error_points = WholeNumber(text);
    session_.SetErrorPoints(o.error_points);
  };
  s.Add(points);
  Setting seed = points;
  seed.name = "seed";
  seed.help = "Seed of what is drawn at random";
  seed.get = [&o] { return std::to_string(o.seed); };
  seed.set = [&o, changed](const std::string& text) {
    o.seed = WholeNumber(text);
    changed();
  };
  s.Add(seed);
  // No part of the solution: whatever comes next is done by so many, and what there is stays.
  Setting threads = points;
  threads.name = "threads";
  threads.help = "Threads, 0: all";
  threads.get = [] { return std::to_string(ThreadCount()); };
  threads.set = [](const std::string& text) {
    const std::uint64_t count = WholeNumber(text);
    if (count > kMostThreads) throw InputError(fmt::format("'{}' are too many", text));
    SetThreadCount(static_cast<int>(count));
  };
  s.Add(threads);
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
