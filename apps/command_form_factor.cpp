// penumbra form-factor: the fraction of the flux from some faces that reaches others.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/form_factor_matrix_run.h"
#include "apps/interruptible.h"
#include "apps/load_scene.h"
#include "apps/named_faces.h"
#include "apps/option_values.h"
#include "apps/options_used.h"
#include "apps/output.h"
#include "apps/scene_arguments.h"
#include "solver/base/check.h"
#include "solver/transport/form_factors/link_form_factor_methods.h"
#include "solver/visibility/area/area_form_factor.h"
#include "solver/visibility/exact/occlusion_methods.h"
#include "solver/visibility/point/occlusion_method.h"

namespace penumbra {
namespace {

constexpr const char *kAuto = "auto", *kExact = "exact";
constexpr const char* kSampled = "sampled";  // of the methods at points, not here

// Doubles do not keep more digits of a form factor.
constexpr NumberRule kTolerance{[](double x) { return x >= 1e-13 && x <= 1; }, "a number from 1e-13 to 1"};

struct FormFactorArguments {
  SceneArguments scene;
  std::string from, to;
  MatrixArguments matrix;
  std::string method = kExact;
  std::optional<double> tolerance;
  std::uint64_t resolution = 0;  // 0: the method's
  std::uint64_t rays = 1'000'000;
};

// Exact ways to find occlusion at a point.
std::vector<std::string> PointMethods() {
  std::vector<std::string> names = OcclusionMethods().Names();
  std::erase(names, kSampled);
  return names;
}

bool IsAtPoints(const std::string& method) {
  const std::vector<std::string> names = PointMethods();
  return std::find(names.begin(), names.end(), method) != names.end();
}

// Samples jump from point to point: no quadrature settles on them, nor can tell how far off they are.
std::string WhyNotSampled(const std::string& method) {
  if (method != kSampled) return "";
  return "sampled visibility cannot be integrated with an error that holds; use cubature or monte-carlo";
}

// Whether point factors are integrated to the tolerance.
bool Integrates(const std::string& method) {
  return method == kAuto || method == kExact || IsAtPoints(method);
}

bool Takes(const std::string& method, const char* parameter) {
  for (const LinkFormFactorRegistry::Method& of : LinkFormFactorMethods().methods())
    if (of.name == method)
      return std::find(of.parameters.begin(), of.parameters.end(), parameter) != of.parameters.end();
  return false;
}

// The methods that take this parameter.
std::string Takers(const char* parameter) {
  std::vector<std::string> names;
  for (const std::string& name : LinkFormFactorMethods().Names())
    if (Takes(name, parameter)) names.push_back(name);
  return fmt::format("{}", fmt::join(names, ", "));
}

// What only some methods take.
void CheckMethod(const FormFactorArguments& arguments) {
  const auto given = [&](const char* name) { return arguments.scene.app->get_option(name)->count() > 0; };
  if (given("--tolerance") && !Integrates(arguments.method))
    throw UsageError(fmt::format(
        "--tolerance is of exact point factors, and --method {} has none; leave one out", arguments.method));
  for (const char* parameter : {"resolution", "rays"})
    if (given(fmt::format("--{}", parameter).c_str()) && !Takes(arguments.method, parameter))
      throw UsageError(fmt::format("--{0} is of {1}, and --method {2} takes none; leave one out", parameter,
                                   Takers(parameter), arguments.method));
}

std::vector<AreaPart> FindParts(const FormFactorArguments& arguments, const Scene& scene,
                                const std::string& name) {
  std::vector<AreaPart> parts;
  for (const std::int32_t face : FacesNamed(scene, arguments.scene.scene, name))
    for (AreaPart& part : PartsOfFace(scene, face)) parts.push_back(std::move(part));
  if (parts.empty())
    throw InputError(fmt::format("{}: error: nothing is left of `{}`: it has no faces, or they were dropped",
                                 arguments.scene.scene, name));
  return parts;
}

// The whole matrix.
void RunMatrix(FormFactorArguments arguments) {
  if (!Integrates(arguments.method))
    throw UsageError(fmt::format("--all computes exact factors, and --method {} is none; leave one out",
                                 arguments.method));
  arguments.scene.outputs.Add("-o", arguments.matrix.output);
  const LoadedScene loaded = LoadScene(arguments.scene);
  if (arguments.scene.verbose) {
    nlohmann::ordered_json options = OptionsUsed(arguments.scene, nullptr);
    options["all"] = true;
    options["by"] = MatrixRowsName(arguments.matrix.by);
    options["method"] = arguments.method;
    if (arguments.tolerance) options["tolerance"] = *arguments.tolerance;
    PrintOptionsUsed(options);
  }
  const std::unique_ptr<const OcclusionMethod> method =
      IsAtPoints(arguments.method) ? OcclusionMethods().Make(arguments.method, {}) : nullptr;
  WriteFormFactorMatrix(loaded.scene, arguments.matrix, method.get(), arguments.tolerance);
}

// What says which factors are asked for.
void CheckEnds(const FormFactorArguments& arguments) {
  const auto given = [&](const char* name) { return arguments.scene.app->get_option(name)->count() > 0; };
  if (arguments.matrix.all && (given("--from") || given("--to")))
    throw UsageError("--all is every pair, and --from and --to are one; leave --all out, or both others");
  if (!arguments.matrix.all && !(given("--from") && given("--to")))
    throw UsageError("form-factor needs --from OBJECT and --to OBJECT, or --all");
  if (!arguments.matrix.all && (given("--by") || given("-o")))
    throw UsageError(fmt::format("{} is of --all; give it, too", given("--by") ? "--by" : "-o"));
}

// By exact point factors, with occlusion found as the method says.
FormFactorEstimate Integrate(const FormFactorArguments& arguments, const Scene& scene,
                             std::span<const AreaPart> from, std::span<const AreaPart> to,
                             const ExecutionContext& context) {
  const std::unique_ptr<const OcclusionMethod> method =
      IsAtPoints(arguments.method) ? OcclusionMethods().Make(arguments.method, {}) : nullptr;
  AreaFormFactorOptions options;
  options.method = method.get();
  options.tolerance = arguments.tolerance.value_or(options.tolerance);
  // What was asked for is given; without a word, what is cheap.
  if (arguments.tolerance) options.clear_tolerance = options.small_error = options.tolerance;
  options.context = &context;
  return AreaFormFactor(scene, from, to, options);
}

FormFactorEstimate Find(const FormFactorArguments& arguments, const Scene& scene,
                        std::span<const AreaPart> from, std::span<const AreaPart> to,
                        const ExecutionContext& context) {
  context.Report(arguments.method, 0);  // the approximate methods tell no more
  if (Integrates(arguments.method)) return Integrate(arguments, scene, from, to, context);
  LinkFormFactorOptions options;
  options.resolution = static_cast<std::size_t>(arguments.resolution);
  options.rays = static_cast<std::size_t>(arguments.rays);
  options.seed = arguments.scene.solving.seed;
  const std::optional<FormFactorEstimate> found =
      LinkFormFactorMethods().Make(arguments.method, options)->Between(scene, from, to, context);
  if (!found)
    throw InputError(
        fmt::format("--method {} finds form factors of links only; give another method", arguments.method));
  return *found;
}

void PrintFormFactor(const FormFactorArguments& arguments) {
  CheckEnds(arguments);
  CheckMethod(arguments);
  if (arguments.matrix.all) return RunMatrix(arguments);
  const LoadedScene loaded = LoadScene(arguments.scene);
  const Scene& scene = loaded.scene;
  const std::vector<AreaPart> from = FindParts(arguments, scene, arguments.from),
                              to = FindParts(arguments, scene, arguments.to);
  if (arguments.scene.verbose) {
    nlohmann::ordered_json options = OptionsUsed(arguments.scene, nullptr);
    options["from"] = arguments.from;
    options["to"] = arguments.to;
    options["method"] = arguments.method;
    if (Integrates(arguments.method) && arguments.tolerance) options["tolerance"] = *arguments.tolerance;
    if (arguments.resolution > 0) options["resolution"] = arguments.resolution;
    if (Takes(arguments.method, "rays")) options["rays"] = arguments.rays;
    PrintOptionsUsed(options);
  }
  FormFactorEstimate estimate;
  RunInterruptible(
      [&](const ExecutionContext& context) { estimate = Find(arguments, scene, from, to, context); });
  WriteResult(std::nullopt, fmt::format("{:.17g} {:.17g}\n", estimate.factor, estimate.error));
}

}  // namespace

Command AddFormFactorCommand(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "form-factor", "Print the form factor from some faces to others, or the matrix of all");
  const auto arguments = std::make_shared<FormFactorArguments>();
  AddSceneArguments(*app, &arguments->scene);
  arguments->scene.lit = false;
  app->add_option("--from", arguments->from, "Where the flux leaves: an object, a group or a face's number")
      ->type_name("OBJECT");
  app->add_option("--to", arguments->to, "Where it arrives: an object, a group or a face's number")
      ->type_name("OBJECT");
  AddMatrixOptions(*app, &arguments->matrix);
  std::vector<std::string> methods = PointMethods();
  methods.insert(methods.begin(), {kAuto, kExact});
  std::string help =
      "auto, exact: exact point factors past all blockers, integrated to the tolerance; clipping, "
      "backprojection and vertex-tracing: the same, occlusion found so (see probe)";
  for (const LinkFormFactorRegistry::Method& method : LinkFormFactorMethods().methods()) {
    if (method.name == kExact) continue;
    methods.push_back(method.name);
    help += fmt::format("; {}: {}", method.name, method.help);
  }
  app->add_option("--method,--form-factors", arguments->method, help)
      ->check(&WhyNotSampled)
      ->check(CLI::IsMember(methods))
      ->type_name("METHOD")
      ->capture_default_str();
  AddNumber(*app, "--tolerance", &arguments->tolerance, kTolerance,
            "auto, exact and their like: the error that is asked for, relative to the factor; of factors "
            "that are less than it, relative to itself. Left out: 1e-7 where something stands in between, "
            "and what roundings allow where nothing does. With --all: what the errors of a row may add up to "
            "(default: 1e-6)");
  AddInteger(
      *app, "--resolution", &arguments->resolution, std::uint64_t{0}, kMostResolution,
      Takers("resolution") + ": cells along a side of their planes; 0: as many as each was printed with");
  AddInteger(*app, "--rays", &arguments->rays, std::uint64_t{1}, std::uint64_t{1} << 40,
             Takers("rays") + ": the number of rays, or of pairs of points");
  app->footer(
      "Prints `F error`: the fraction of the diffuse flux that leaves the front of the one and reaches the\n"
      "front of the other past the whole scene, and how far off that may be. Of several faces the flux is\n"
      "summed: sum A_i F(i -> to) / sum A_i. The error of exact bounds it by an estimate; that of\n"
      "monte-carlo and malley is the standard error; the others' are differences from a coarser or finer\n"
      "division, which indicate and do not bound. A name goes before a number.\n"
      "With --all the matrix goes to -o or standard output, and its errors, closure (what rows add up to) "
      "and\n"
      "reciprocity to standard output, or to standard error. A_i F_ij = A_j F_ji holds to rounding: each "
      "pair\n"
      "is computed once.");
  return {app, [arguments] { PrintFormFactor(*arguments); }};
}

}  // namespace penumbra
