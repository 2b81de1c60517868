#include "apps/scene_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>

#include "apps/option_values.h"
#include "solver/base/parallel.h"
#include "solver/scene/named_scene.h"

namespace penumbra {
namespace {

constexpr int kMaxThreads = 1024;
constexpr std::uint64_t kMaxErrorPoints = 100'000'000;
constexpr NumberRule kBelowOne{[](double x) { return x >= 0 && x < 1; }, "a number in [0, 1)"};

constexpr std::array<NamedValue<DiscontinuityChoice>, 5> kDiscontinuityChoices = {
    {{"ranked", DiscontinuityChoice::kRanked},
     {"adaptive", DiscontinuityChoice::kAdaptive},
     {"none", DiscontinuityChoice::kNone},
     {"random", DiscontinuityChoice::kRandom},
     {"all", DiscontinuityChoice::kAll}}};
constexpr std::array<NamedValue<DiscontinuityWeight>, 2> kDiscontinuityWeights = {
    {{"thesis", DiscontinuityWeight::kThesis}, {"irradiance", DiscontinuityWeight::kIrradiance}}};

}  // namespace

void AddSceneArguments(CLI::App& app, SceneArguments* arguments) {
  app.add_option("SCENE", arguments->scene, "An OBJ file or the name of a built-in scene; a file wins")
      ->required()
      ->type_name("");
  app.add_flag("--emission-is-radiance", arguments->reading.emission_is_radiance,
               "Ke is radiance in W/(m^2 sr) instead of emittance in W/m^2: multiply it by pi")
      ->group("Scene");
  app.add_flag("--two-sided", arguments->reading.two_sided,
               "Repeat every face, reversed, after the last: the back of face i is n + i")
      ->group("Scene");
  AddNumber(app, "--max-reflectance", &arguments->reading.max_reflectance, kBelowOne,
            "Clamp larger reflectances to X, in [0, 1), instead of refusing those of 1 or more")
      ->group("Scene");
  AddInteger(app, "--threads", &arguments->threads, 0, kMaxThreads,
             "Threads to work with, 0: all; the result is the same for any number")
      ->group("Running");
  AddInteger(app, "--seed", &arguments->solving.seed, std::uint64_t{0},
             std::numeric_limits<std::uint64_t>::max(), "Seed of everything that is drawn at random")
      ->group("Running");
  app.add_flag("-v,--verbose", arguments->verbose,
               "Tell on standard error which options were used, and what a solve took and reached")
      ->group("Running");
}

void AddSolveOptions(CLI::App& app, SceneArguments* arguments) {
  PipelineOptions* solving = &arguments->solving;
  const std::string group = "Solving";
  AddNumber(app, "--error", &solving->error, kPositive,
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
      app, "--discontinuities", &solving->discontinuities, kDiscontinuityChoices,
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
  AddInteger(app, "--max-leaf-dsets", &solving->max_leaf_dsets, 0, 1'000'000,
             "Most discontinuity lines in a leaf of the mesh")
      ->group(group);
  AddNumber(app, "--relative-cutoff", &solving->relative_cutoff, kPositive,
            "Iterate until no radiosity is farther off, relative to the largest (default: follows from "
            "--error)")
      ->group(group);
  AddInteger(
      app, "--corrections", &solving->max_corrections, 0, 100,
      "Passes that correct the converged solution by exact irradiance; 0: links alone, as in the thesis")
      ->group(group);
  app.add_flag("!--no-acceleration", solving->accelerate,
               "Plain Jacobi sweeps, as in the thesis, instead of guessing ahead (Anderson 1965)")
      ->group(group);
  AddInteger(app, "--iterations", &solving->max_iterations, 1, 1'000'000,
             "Most iterations of gathering and refining")
      ->group(group);
  AddNumber(
      app, "--nudge", &solving->point.nudge, kNonNegative,
      "Move points that ask for a limit this far towards the inside of their triangle [m], as the thesis "
      "does, instead of taking the limit; 0: limits")
      ->group(group);
  AddNumber(app, "--source-push-off", &solving->point.source_push_off, kNonNegative,
            "Lift sources this far off each receiver [m], as the thesis does where they touch it; 0: not")
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

nlohmann::ordered_json OptionsUsed(const SceneArguments& arguments, const ResolvedOptions* resolved) {
  nlohmann::ordered_json options;
  options["scene"] = arguments.scene;
  options["emission_is_radiance"] = arguments.reading.emission_is_radiance;
  options["two_sided"] = arguments.reading.two_sided;
  if (arguments.reading.max_reflectance) options["max_reflectance"] = *arguments.reading.max_reflectance;
  options["threads"] = ThreadCount();
  options["seed"] = arguments.solving.seed;
  if (resolved) {
    options["error"] = arguments.solving.error;
    options["eps"] = resolved->solver.eps;
    options["min_area"] = resolved->solver.min_area;
    const DiscontinuityOptions& mesh = resolved->discontinuities;
    options["discontinuities"] = NameOf(mesh.choice, kDiscontinuityChoices);
    options["weight"] = NameOf(mesh.weight, kDiscontinuityWeights);
    options["min_discontinuity_weight"] = mesh.min_weight;
    options["max_leaf_dsets"] = mesh.max_leaf_dsets;
    options["keep_hidden_discontinuities"] = mesh.keep_hidden;
    options["corrections"] = resolved->solver.max_corrections;
    options["acceleration"] = resolved->solver.accelerate;
    options["relative_cutoff"] = resolved->solver.relative_cutoff;
    options["iterations"] = resolved->solver.max_iterations;
    options["nudge"] = arguments.solving.point.nudge;
    options["source_push_off"] = arguments.solving.point.source_push_off;
    options["error_points"] = arguments.solving.error_points;
  }
  return options;
}

void PrintOptionsUsed(const nlohmann::ordered_json& options) {
  std::string block = "Options used:\n";
  for (const auto& [key, value] : options.items()) {
    std::string name = key;
    std::replace(name.begin(), name.end(), '_', '-');
    block += fmt::format("   --{} {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  fmt::print(stderr, "{}", block);
}

LoadedScene LoadScene(const SceneArguments& arguments) {
  SetThreadCount(arguments.threads);
  const auto begin = std::chrono::steady_clock::now();
  LoadedScene loaded{ReadNamedScene(arguments.scene, arguments.reading), 0};
  loaded.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  for (const std::string& warning : loaded.scene.warnings) fmt::print(stderr, "{}\n", warning);
  return loaded;
}

}  // namespace penumbra
