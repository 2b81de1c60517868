#include "apps/dim_option.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/option_values.h"
#include "mesh/refinement/emitter_light.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

// A lamp a million times as bright is a mistake of writing.
constexpr NumberRule kFactor{[](double x) { return x >= 0 && x <= 1e6; }, "a number from 0 to 1e6"};

std::optional<Rgb> ParseFactor(std::string_view text) {
  std::optional<Vec3> factor = ParseVector(text);
  if (!factor)
    if (const std::optional<double> number = ParseNumber(text)) factor = Vec3::Constant(*number);
  if (!factor || !kFactor.holds(factor->x()) || !kFactor.holds(factor->y()) || !kFactor.holds(factor->z()))
    return std::nullopt;
  return Rgb(factor->array());
}

std::vector<Rgb> FactorsOfPatches(const Scene& scene, std::span<const Dimming> dims) {
  try {
    return DimmingFactors(scene, dims);
  } catch (const InputError& error) {
    throw UsageError(fmt::format("--dim: {}", error.what()));
  }
}

// What the solution keeps as one emitter can be dimmed only as a whole.
std::vector<Rgb> FactorsOfEmitters(const Scene& scene, std::span<const EmitterLight> emitters,
                                   std::span<const Rgb> of_patch) {
  std::vector<Rgb> factors;
  for (const EmitterLight& emitter : emitters) {
    const auto factor = [&](PatchId patch) { return of_patch[static_cast<std::size_t>(patch)]; };
    factors.push_back(emitter.patches.empty() ? Rgb::Ones() : factor(emitter.patches[0]));
    for (const PatchId patch : emitter.patches) {
      if ((factor(patch) == factors.back()).all()) continue;
      const auto face = [&](PatchId p) { return scene.patches[static_cast<std::size_t>(p)].faces[0]; };
      throw UsageError(
          fmt::format("--dim: the solution keeps the light of faces {} and {} as one; dim both alike, or "
                      "solve again with "
                      "--by-emitter --emitters face",
                      face(emitter.patches[0]), face(patch)));
    }
  }
  return factors;
}

// The errors were measured of another light.
void ForgetErrors(PipelineReport& report) {
  report.interpolant_error = report.whole_error = {};
  report.part_errors.clear();
  report.solution_error_estimate = 0;
  report.error_met = false;
  std::erase_if(report.unmet, [](const std::string& line) { return line.starts_with("error: "); });
}

}  // namespace

CLI::Option* AddDimOption(CLI::App& app, SceneArguments* arguments) {
  const auto read = [arguments](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t equals = text.rfind('=');
      const std::optional<Rgb> factor =
          equals == text.npos ? std::nullopt : ParseFactor(std::string_view(text).substr(equals + 1));
      if (!factor)
        throw CLI::ValidationError(
            "--dim", fmt::format("'{}' is not NAME=FACTOR or NAME=r,g,b, each {}", text, kFactor.words));
      arguments->dims.push_back({text.substr(0, equals), *factor});
    }
  };
  return app
      .add_option_function<std::vector<std::string>>(
          "--dim", read,
          "Multiply the light of an emitter, named by its object or group, its material or the number of a "
          "face. "
          "A solution made by `solve --by-emitter` is not solved again; a scene is solved with the other "
          "emittance; may be repeated")
      ->type_name("NAME=FACTOR")
      ->group("Light")
      ->expected(1)
      ->take_all();
}

void DimScene(std::span<const Dimming> dims, Scene& scene) {
  if (dims.empty()) return;
  try {
    ScaleEmittance(scene, FactorsOfPatches(scene, dims));
  } catch (const InputError& error) {
    throw UsageError(fmt::format("--dim: {}", error.what()));
  }
}

LoadedScene DimSolution(const SceneArguments& arguments, LoadedScene loaded) {
  StoredSolve& stored = *loaded.stored;
  const std::vector<Rgb> of_patch = FactorsOfPatches(loaded.scene, arguments.dims);
  if (stored.state.emitters.empty())
    throw InputError(fmt::format(
        "{}: error: it does not keep the light of each emitter; make it by `penumbra solve --by-emitter`, or "
        "give the scene to solve it dimmed",
        arguments.scene));
  const std::vector<Rgb> factors = FactorsOfEmitters(loaded.scene, stored.state.emitters, of_patch);
  Scene scene = loaded.scene;
  DimScene(arguments.dims, scene);
  LoadedScene dimmed{std::make_unique<const Scene>(std::move(scene))};
  RadiositySolution& solution = stored.state.solution;
  solution.forest = solution.forest.Of(dimmed.scene);
  ScaleLights(factors, stored.state.emitters, solution, stored.state.mesh);
  if (std::any_of(factors.begin(), factors.end(), [](const Rgb& f) { return (f != 1).any(); }))
    ForgetErrors(stored.state.report);
  dimmed.stored = std::move(stored);
  return dimmed;
}

}  // namespace penumbra
