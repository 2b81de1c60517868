#include "apps/scene_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <string_view>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/option_checks.h"
#include "apps/option_values.h"
#include "apps/report.h"
#include "apps/scene_warnings.h"
#include "mesh/discontinuities/discontinuity_choices.h"
#include "mesh/pipeline/link_options.h"
#include "mesh/pipeline/solution_file.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/read_file.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/file_format.h"
#include "solver/scene/named_scene.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/text_reader.h"
#include "solver/transport/links/link_form_factor_methods.h"
#include "solver/transport/links/refinement_oracles.h"
#include "solver/transport/solvers/light_solvers.h"

namespace penumbra {
namespace {

constexpr int kMaxThreads = 1024;
constexpr std::uint64_t kMaxErrorPoints = 100'000'000;
constexpr const char *kSceneGroup = "Scene", *kSolvingGroup = "Solving";
constexpr const char* kAcceleration = "acceleration";  // among the options used; the flag turns it off
constexpr int kMaxErrorSamples = 100;
constexpr NumberRule kBelowOne{[](double x) { return x >= 0 && x < 1; }, "a number in [0, 1)"};
constexpr NumberRule kShare{[](double x) { return x >= 0 && x <= 1; }, "a number from 0 to 1"};
constexpr NumberRule kCutoff{[](double x) { return x >= 1e-15 && x <= 1; }, "a number from 1e-15 to 1"};
// How near a polyline keeps to a curve: nearer than a nanometre it would have pieces without end.
constexpr NumberRule kPolyline{[](double x) { return x == 0 || (x >= 1e-9 && x <= 1e9); },
                               "0, or a number from 1e-9 to 1e9"};
constexpr NumberRule kSeconds{[](double x) { return x >= 1e-9 && x <= 1e9; }, "a number from 1e-9 to 1e9"};
constexpr NumberRule kBytes{[](double x) { return x >= 1 && x <= 1e18; }, "a number from 1 to 1e18"};
constexpr Choice<IterationScheme> kSchemes[] = {{"jacobi", IterationScheme::kJacobi},
                                                {"gauss-seidel", IterationScheme::kGaussSeidel}};
constexpr Choice<BasisDegree> kBases[] = {{"constant", BasisDegree::kConstant},
                                          {"linear", BasisDegree::kLinear},
                                          {"quadratic", BasisDegree::kQuadratic}};
constexpr Choice<RefineBy> kRefinements[] = {{"transport", RefineBy::kTransport},
                                             {"representation", RefineBy::kRepresentation},
                                             {"both", RefineBy::kBoth}};

constexpr Choice<DiscontinuityWeight> kDiscontinuityWeights[] = {
    {"thesis", DiscontinuityWeight::kThesis}, {"irradiance", DiscontinuityWeight::kIrradiance}};

// Whether the file is, or was meant to be, a solution: its content tells. Nothing tells what an empty file
// is; one that is named as a scene is a scene without faces.
bool IsSolution(const std::string& path) {
  // What a pipe brings can be read once only: it is taken for a scene.
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  try {
    const std::string beginning = ReadFileStart(path, std::max(kSolutionHeaderSize, kFormatBytes));
    if (beginning.empty()) return !HasSceneEnding(path);
    const std::optional<ForeignFormat> format = FindForeignFormat(beginning);
    if (format) return format->kind == FormatKind::kSolution || format->kind == FormatKind::kHdf5;
    return LooksLikeSolution(beginning);
  } catch (const ReadFailure&) {
    return false;  // whoever reads the scene tells why
  }
}

// Options that say how a scene is read or solved have no place beside a solution.
void RefuseSceneOptions(const SceneArguments& arguments) {
  if (!arguments.app) return;
  for (const CLI::Option* option : arguments.app->get_options())
    if (option->count() > 0 && (option->get_group() == kSceneGroup || option->get_group() == kSolvingGroup))
      throw UsageError(fmt::format(
          "{} says how a scene is {}, but '{}' is a solution; give the scene, or leave it out",
          option->get_name(), option->get_group() == kSceneGroup ? "read" : "solved", arguments.scene));
}

// The scene that was named, with the materials that were changed.
Scene ReadChangedScene(const SceneArguments& arguments) {
  SceneOptions options = arguments.reading;
  options.change_materials = [&](std::vector<Material>& materials) {
    ChangeMaterials(arguments.emittance, &Material::emittance, materials);
    ChangeMaterials(arguments.reflectance, &Material::reflectance, materials);
  };
  options.before_library = [&](const std::string& path) { arguments.outputs.RefuseInput(path); };
  Scene scene = ReadNamedScene(arguments.scene, options);
  for (const std::string& warning : SceneWarnings(scene, arguments.lit))
    scene.warnings.push_back(fmt::format("{}: warning: {}", arguments.scene, warning));
  return scene;
}

}  // namespace

LoadedScene LoadSolution(const std::string& path) {
  constexpr const char* kMend = "; give a solution that `penumbra solve -o` wrote";
  std::string bytes;
  try {
    bytes = ReadFileBytes(path);
  } catch (const ReadFailure& failure) {
    throw ErrorAt(path, 0, std::string(failure.what()) + kMend);
  }
  if (!IsSolution(path)) throw ErrorAt(path, 0, std::string("it is no solution") + kMend);
  StoredSolution solution = DecodeSolution(bytes, path);
  LoadedScene loaded{std::move(solution.scene)};
  StoredRun& stored = loaded.stored.emplace();
  stored.state = std::move(solution.state);
  stored.version = std::move(solution.version);
  try {
    stored.options = nlohmann::ordered_json::parse(solution.options);
    stored.solving = SolvingFrom(stored.options);
    stored.state.report = PipelineReportFrom(nlohmann::ordered_json::parse(solution.report));
    stored.state.report.quality = MeasureQuality(stored.state.mesh);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw ErrorAt(path, 0, std::string("its options or its report cannot be read: ") + error.what());
  }
  return loaded;
}

void AddRunningOptions(CLI::App& app, int* threads, std::uint64_t* seed, bool* verbose) {
  AddInteger(app, "--threads", threads, 0, kMaxThreads,
             "Threads to work with, 0: all; the result is the same for any number")
      ->group("Running");
  AddInteger(app, "--seed", seed, std::uint64_t{0}, std::numeric_limits<std::uint64_t>::max(),
             "Seed of everything that is drawn at random")
      ->group("Running");
  app.add_flag("-v,--verbose", *verbose,
               "Tell on standard error which options were used, and what a solve took and reached")
      ->group("Running");
}

void AddSceneArguments(CLI::App& app, SceneArguments* arguments) {
  arguments->app = &app;
  app.add_option(
         "SCENE", arguments->scene,
         "An OBJ file, the name of a built-in scene (a file wins), or a solution that `solve -o` wrote")
      ->required()
      ->type_name("");
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
  AddNumber(app, "--max-reflectance", &arguments->reading.max_reflectance, kBelowOne,
            "Clamp larger reflectances to X, in [0, 1), instead of refusing those of 1 or more")
      ->group(kSceneGroup);
  AddMaterialChange(app, "--emittance", &arguments->emittance, kEmittance,
                    "Another emittance for a material [W/m^2]; may be repeated")
      ->group(kSceneGroup);
  AddMaterialChange(app, "--reflectance", &arguments->reflectance, kBelowOne,
                    "Another reflectance for a material, in [0, 1); may be repeated")
      ->group(kSceneGroup);
  AddRunningOptions(app, &arguments->threads, &arguments->solving.seed, &arguments->verbose);
}

void AddSolveOptions(CLI::App& app, SceneArguments* arguments) {
  PipelineOptions* solving = &arguments->solving;
  const std::string group = kSolvingGroup;
  AddNumber(app, "--error", &solving->error, kRelativeError,
            "The relative error of what is shown that 99 points in 100 shall not exceed; all below follows "
            "from it unless it is given")
      ->group(group);
  AddNumber(app, "--eps", &solving->eps, kPositive,
            "Largest transport error of a link [W/m^2], largest channel (default: follows from --error)")
      ->group(group);
  AddNumber(app, "--min-area", &solving->min_area, kNonNegative,
            "Smallest area of an element [m^2] (default: follows from --error)")
      ->group(group);
  AddNumber(app, "--min-discontinuity-weight", &solving->min_discontinuity_weight, kNonNegative,
            "Smallest weight of a discontinuity in the mesh [W/m^2] (default: follows from --error)")
      ->group(group);
  AddChoice(
      app, "--discontinuities", &solving->discontinuities, DiscontinuityChoices().Names(),
      "Which become edges of the mesh, as many as a leaf may have: the heaviest (default), those where a "
      "shadow boundary is seen to cross a leaf (Stuerzlinger 1994), none, any in random order; or all of "
      "them")
      ->group(group);
  AddChoice(
      app, "--weight", &solving->weight, kDiscontinuityWeights,
      "What a discontinuity weighs [W/m^2]: how near its blocker is times the source's radiosity, or the "
      "error that a leaf would make without it (default: thesis where the smallest weight is given, else "
      "irradiance)")
      ->group(group);
  app.add_flag("--keep-hidden-discontinuities", solving->keep_hidden_discontinuities,
               "Also those parts that end at another blocker on their way, as in the thesis")
      ->group(group);
  AddNumber(
      app, "--min-wanted-weight", &solving->min_wanted_weight, kNonNegative,
      "Least error on a leaf for whose sake refinement may ask for a discontinuity, where that mends more "
      "than dividing leaves; it begins with those of twice the smallest weight [W/m^2] (default: follows "
      "from --error; none where the smallest weight is given)")
      ->group(group);
  AddInteger(app, "--corner-divisions", &solving->corner_divisions, 0, kMostCornerDivisions,
             "Divide leaves of the mesh so many times towards the ends of contact edges")
      ->group(group);
  AddNumber(app, "--eee", &solving->triple_edge_tolerance, kPolyline,
            "Also triple-edge (EEE) discontinuities, as polylines that keep within so many metres of them; "
            "0: none, as in the thesis")
      ->group(group);
  AddInteger(app, "--max-leaf-dsets", &solving->max_leaf_dsets, 0, 1'000'000,
             "Most discontinuity lines in a leaf of the mesh")
      ->group(group);
  AddInteger(app, "--error-samples", &solving->error_samples, 1, kMaxErrorSamples,
             "Measure a triangle of the mesh at N x N points to decide whether it is fine enough")
      ->group(group);
  AddChoice(app, "--refine", &solving->refine, kRefinements,
            "Refine by the error of links alone (transport), by that of what is shown over a coarse solution "
            "(representation), or by both")
      ->group(group);
  AddNumber(app, "--relative-cutoff", &solving->relative_cutoff, kCutoff,
            "Iterate until no radiosity is farther off, relative to the largest (default: follows from "
            "--error)")
      ->group(group);
  AddInteger(
      app, "--corrections", &solving->max_corrections, 0, 100,
      "Passes that correct the converged solution by exact irradiance; 0: links alone, as in the thesis")
      ->group(group);
  AddNumber(
      app, "--source-error", &solving->source_error, kRelativeError,
      "The corrections cut sources into strips and pieces until constant light on each errs by about this "
      "much, relative, where it arrives; grades them towards edges where walls meet (default: the mesh "
      "cuts them)")
      ->group(group);
  app.add_flag_callback(
         "--no-acceleration", [solving] { solving->acceleration = Acceleration::kNone; },
         "Sweep after sweep, as in the thesis, instead of guessing ahead (Anderson 1965)")
      ->group(group);
  AddChoice(
      app, "--scheme", &solving->scheme, kSchemes,
      "Order of a sweep: all elements from the light before it (the thesis), or patch after patch, each "
      "from the light as it is then")
      ->group(group);
  AddChoice(app, "--oracle", &solving->oracle, RefinementOracles().Names(),
            "What splits links: their transport error, by its deviation over the receiver; the same, partial "
            "links counting twice; by the gradient of the form factor; or as printed in the thesis, without "
            "regard to area")
      ->group(group);
  app.add_flag("--multigrid", solving->multigrid,
               "Refine by a larger --eps first, lowered from one iteration to the next")
      ->group(group);
  AddInteger(app, "--iterations", &solving->max_iterations, 1, 1'000'000,
             "Most iterations of gathering and refining")
      ->group(group);
  AddNumber(app, "--time-limit", &solving->time_limit, kSeconds,
            "End the work after this many seconds, reading included, with the last whole step's light, its "
            "mesh without refining it, and no more measured than there was time for")
      ->group(group);
  AddNumber(app, "--memory-limit", &solving->memory_limit, kBytes,
            "End them in the same way when the program takes this many bytes of memory")
      ->group(group);
  AddInteger(app, "--bounces", &solving->bounces, 0, 1000,
             "Report the mean irradiance of so many bounces, from the links")
      ->group(group);
  AddNumber(
      app, "--nudge", &solving->point.nudge, kNonNegative,
      "Move points that ask for a limit this far towards the inside of their triangle [m], as the thesis "
      "does, instead of taking the limit; 0: limits; at most a thousandth of the scene's diagonal")
      ->group(group);
  AddNumber(app, "--source-push-off", &solving->point.source_push_off, kNonNegative,
            "Lift sources this far off each receiver [m], as the thesis does where they touch it; 0: not; at "
            "most a thousandth of the scene's diagonal")
      ->group(group);
  AddNumber(app, "--min-backprojection-segment", &solving->point.min_backprojection_segment, kShare,
            "Find shadows at points by backprojection, and collapse segments of a blocker's outline shorter "
            "than this, "
            "relative to the source's diameter as seen, as the thesis does; 0: the fastest exact way")
      ->group(group);
  AddChoice(
      app, "--form-factors", &solving->form_factors, LinkFormFactorMethods().Names(),
      "Of links: the mean of exact point factors over a few points of the receiver (cubature); between areas "
      "to "
      "1e-7, slower, and closed rooms then close (exact); or the source as a disk seen from the receiver's "
      "centre, to compare (disk, Hanrahan et al. 1991)")
      ->group(group);
  app.add_option_function<std::string>(
         "--solver", [solving](const std::string& name) { solving->solver = name; },
         "How to solve: `hierarchical`, or `dense`, which solves the linear system of a uniform mesh "
         "directly "
         "with exact form factors: a reference for small scenes")
      ->check(CLI::IsMember(LightSolvers().Names()))
      ->default_str("hierarchical")
      ->group(group);
  // --solver, which comes before, has been read.
  const auto need_dense = [solving](const char* option) {
    if (solving->solver != "dense")
      throw CLI::ValidationError(option, "it is of the dense solver; give --solver dense, or leave it out");
  };
  app.add_option_function<std::string>(
         "--basis",
         [solving, need_dense](const std::string& name) {
           need_dense("--basis");
           solving->dense.degree = ChoiceValue(kBases, name);
         },
         "Of the dense solver's elements: `constant` (Galerkin), `linear` or `quadratic` (collocation; their "
         "means are shown)")
      ->check(CLI::IsMember(std::vector<std::string>{"constant", "linear", "quadratic"}))
      ->default_str("constant")
      ->group(group);
  app.add_option_function<int>(
         "--divisions",
         [solving, need_dense](const int& divisions) {
           need_dense("--divisions");
           solving->dense.divisions = divisions;
         },
         "The dense solver cuts every patch into N x N elements, N a power of two")
      ->type_name("N")
      ->check(CLI::IsMember(std::vector<int>{1, 2, 4, 8, 16, 32, 64}))
      ->default_str(std::to_string(solving->dense.divisions))
      ->group(group);
  AddInteger(app, "--error-points", &solving->error_points, std::uint64_t{0}, kMaxErrorPoints,
             "Random points at which a report measures the error of the interpolants; 0 leaves that out")
      ->group(group);
}

CLI::Option* AddReportOption(CLI::App& app, SceneArguments* arguments) {
  return app
      .add_option("--report", arguments->report,
                  "Write times, counts, iterations, energy balance and measured error here, as JSON")
      ->type_name("REPORT.json")
      ->group("Running");
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
      ->group(kSolvingGroup);
}

namespace {

// What the dense solver is not told.
void DropHierarchical(nlohmann::ordered_json* options) {
  std::vector<std::string> dropped;
  for (const auto& [key, value] : options->items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    if (IsHierarchicalOption(name)) dropped.push_back(key);
  }
  for (const std::string& key : dropped) options->erase(key);
}

}  // namespace

nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved) {
  nlohmann::ordered_json options;
  options["scene"] = arguments.scene;
  options["emission_is_radiance"] = arguments.reading.emission_is_radiance;
  options["flip"] = arguments.reading.flip;
  options["two_sided"] = arguments.reading.two_sided;
  if (arguments.reading.strict) options["strict"] = true;
  if (arguments.reading.max_reflectance) options["max_reflectance"] = *arguments.reading.max_reflectance;
  for (const auto& [name, changes] :
       {std::pair("emittance", &arguments.emittance), std::pair("reflectance", &arguments.reflectance)})
    for (const MaterialChange& change : *changes)
      options[name][change.material] = {change.value[0], change.value[1], change.value[2]};
  options["threads"] = ThreadCount();
  options["seed"] = arguments.solving.seed;
  if (resolved) {
    options["error"] = arguments.solving.error;
    options["eps"] = resolved->solver.eps;
    options["min_area"] = resolved->solver.min_area;
    const DiscontinuityOptions& mesh = resolved->discontinuities;
    options["discontinuities"] = mesh.choice;
    options["weight"] = ChoiceName(kDiscontinuityWeights, mesh.weight);
    options["min_discontinuity_weight"] = mesh.min_weight;
    options["min_wanted_weight"] = mesh.min_wanted_weight;
    options["corner_divisions"] = mesh.corner_divisions;
    options["max_leaf_dsets"] = mesh.max_leaf_dsets;
    options["keep_hidden_discontinuities"] = mesh.keep_hidden;
    options["eee"] = mesh.triple_edge_tolerance;
    options["error_samples"] = arguments.solving.error_samples;
    options["refine"] = ChoiceName(kRefinements, arguments.solving.refine);
    options["corrections"] = resolved->solver.max_corrections;
    if (arguments.solving.source_error) options["source_error"] = *arguments.solving.source_error;
    options[kAcceleration] = resolved->solver.acceleration == Acceleration::kAnderson;
    options["scheme"] = ChoiceName(kSchemes, resolved->solver.scheme);
    options["oracle"] = resolved->solver.oracle;
    options["multigrid"] = resolved->solver.multigrid;
    options["relative_cutoff"] = resolved->solver.relative_cutoff;
    options["iterations"] = resolved->solver.max_iterations;
    if (arguments.solving.time_limit) options["time_limit"] = *arguments.solving.time_limit;
    if (arguments.solving.memory_limit) options["memory_limit"] = *arguments.solving.memory_limit;
    options["bounces"] = arguments.solving.bounces;
    options["nudge"] = arguments.solving.point.nudge;
    options["source_push_off"] = arguments.solving.point.source_push_off;
    options["min_backprojection_segment"] = arguments.solving.point.min_backprojection_segment;
    options["form_factors"] = arguments.solving.form_factors;
    options["solver"] = arguments.solving.solver;
    if (arguments.solving.solver == "dense") {
      options["basis"] = ChoiceName(kBases, arguments.solving.dense.degree);
      options["divisions"] = arguments.solving.dense.divisions;
    }
    options["error_points"] = arguments.solving.error_points;
    if (arguments.restart) options["restart"] = *arguments.restart;
    if (arguments.solving.solver == "dense") DropHierarchical(&options);
  }
  return options;
}

namespace {

// The text as one word of a shell.
std::string ShellWord(const std::string& text) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,:/@%^";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

// The option as it would be given; nothing for a flag that was not.
std::string OptionText(const std::string& name, const nlohmann::ordered_json& value) {
  if (value.is_boolean()) {
    if (name == kAcceleration) return value.get<bool>() ? "" : fmt::format("   --no-{}\n", name);
    return value.get<bool>() ? fmt::format("   --{}\n", name) : "";
  }
  if (value.is_object()) {  // of materials
    std::string text;
    for (const auto& [material, rgb] : value.items())
      text += fmt::format("   --{} {}\n", name,
                          ShellWord(MaterialChangeText(
                              material, {rgb[0].get<double>(), rgb[1].get<double>(), rgb[2].get<double>()})));
    return text;
  }
  return fmt::format("   --{} {}\n", name,
                     value.is_string() ? ShellWord(value.get<std::string>()) : value.dump());
}

// Whether the option may not be given again: the links of a restart were made with it.
bool IsOfRestart(const std::string& name, const nlohmann::ordered_json& options) {
  return options.contains("restart") &&
         std::find(kLinkOptions.begin(), kLinkOptions.end(), name) != kLinkOptions.end();
}

}  // namespace

void PrintOptionsUsed(const nlohmann::ordered_json& options) {
  // A solution was made of the scene by these, which stand for it.
  std::string block = options.contains("solution")
                          ? fmt::format("Options used, and those that '{}' was solved with:\n",
                                        options["solution"].get<std::string>())
                          : "Options used:\n";
  for (const auto& [key, value] : options.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    if (key == "scene")
      block += fmt::format("   {}\n", ShellWord(value.get<std::string>()));
    else if (key != "solution" && !IsOfRestart(name, options))
      block += OptionText(name, value);
  }
  SayAsItIs(block);
}

namespace {

void TakeHierarchical(const nlohmann::ordered_json& options, PipelineOptions* solving) {
  solving->eps = options.at("eps").get<double>();
  solving->refine = ChoiceValue(kRefinements, options.at("refine").get<std::string>());
  options.at("corrections").get_to(solving->max_corrections);
  if (options.contains("source_error")) solving->source_error = options["source_error"].get<double>();
  solving->acceleration =
      options.at(kAcceleration).get<bool>() ? Acceleration::kAnderson : Acceleration::kNone;
  solving->relative_cutoff = options.at("relative_cutoff").get<double>();
  options.at("iterations").get_to(solving->max_iterations);
  solving->scheme = ChoiceValue(kSchemes, options.at("scheme").get<std::string>());
  solving->oracle = RefinementOracles().Find(options.at("oracle").get<std::string>()).name;
  options.at("multigrid").get_to(solving->multigrid);
  options.at("bounces").get_to(solving->bounces);
  solving->form_factors = LinkFormFactorMethods().Find(options.at("form_factors").get<std::string>()).name;
}

}  // namespace

PipelineOptions SolvingFrom(const nlohmann::ordered_json& options) {
  PipelineOptions solving;
  options.at("seed").get_to(solving.seed);
  options.at("error").get_to(solving.error);
  solving.min_area = options.at("min_area").get<double>();
  solving.min_discontinuity_weight = options.at("min_discontinuity_weight").get<double>();
  options.at("max_leaf_dsets").get_to(solving.max_leaf_dsets);
  // In older files refinement asked for none, and no leaf was divided towards corners.
  solving.min_wanted_weight = options.value("min_wanted_weight", *solving.min_discontinuity_weight);
  solving.corner_divisions = options.value("corner_divisions", 0);
  // Files from before there was a choice are of the thesis's kind.
  solving.weight = ChoiceValue(kDiscontinuityWeights, options.value("weight", "thesis"));
  solving.discontinuities = DiscontinuityChoices().Find(options.value("discontinuities", "ranked")).name;
  solving.keep_hidden_discontinuities = options.value("keep_hidden_discontinuities", false);
  solving.triple_edge_tolerance = options.value("eee", 0.0);
  options.at("error_samples").get_to(solving.error_samples);
  if (options.contains("time_limit")) solving.time_limit = options["time_limit"].get<double>();
  if (options.contains("memory_limit")) solving.memory_limit = options["memory_limit"].get<double>();
  if (options.at("solver") == "dense") {
    solving.solver = "dense";
    solving.dense.degree = ChoiceValue(kBases, options.at("basis").get<std::string>());
    options.at("divisions").get_to(solving.dense.divisions);
  } else {
    TakeHierarchical(options, &solving);
  }
  options.at("nudge").get_to(solving.point.nudge);
  options.at("source_push_off").get_to(solving.point.source_push_off);
  solving.point.min_backprojection_segment = options.value("min_backprojection_segment", 0.0);
  options.at("error_points").get_to(solving.error_points);
  return solving;
}

void TellWarnings(const LoadedScene& loaded) {
  if (loaded.stored) return;
  for (const std::string& warning : loaded.scene.warnings) Say(warning);
}

LoadedScene LoadScene(const SceneArguments& arguments) {
  LoadedScene loaded = LoadQuietly(arguments);
  TellWarnings(loaded);
  return loaded;
}

LoadedScene LoadQuietly(const SceneArguments& arguments) {
  SetThreadCount(arguments.threads);
  CheckOptions(arguments);
  const Stopwatch reading;
  std::error_code ignored;
  if (std::filesystem::exists(arguments.scene, ignored)) arguments.outputs.RefuseInput(arguments.scene);
  const bool is_solution = IsSolution(arguments.scene);
  if (is_solution) RefuseSceneOptions(arguments);
  LoadedScene loaded = is_solution ? LoadSolution(arguments.scene)
                                   : LoadedScene{std::make_unique<const Scene>(ReadChangedScene(arguments))};
  loaded.seconds = reading.Seconds();
  if (!is_solution) CheckDistances(arguments, loaded.scene);
  return loaded;
}

}  // namespace penumbra
