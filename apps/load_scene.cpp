#include "apps/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/commands.h"
#include "apps/dim_option.h"
#include "apps/messages.h"
#include "apps/option_checks.h"
#include "apps/options_used.h"
#include "apps/report.h"
#include "apps/scene_warnings.h"
#include "mesh/pipeline/option_table.h"
#include "mesh/pipeline/solution_file.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/read_file.h"
#include "solver/base/stopwatch.h"
#include "solver/scene/file_format.h"
#include "solver/scene/named_scene.h"
#include "solver/scene/scene_readers.h"
#include "solver/scene/text_reader.h"

namespace penumbra {
namespace {

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

// Whether the option says how a scene is solved; --restart is no entry of the table. A command's own option
// may have the name of an entry, as --method of probe, and then stands in another group.
bool SaysHowToSolve(const CLI::Option& option) {
  return option.get_group() == GroupTitle(OptionGroup::kSolving) ||
         std::any_of(OptionTable().begin(), OptionTable().end(), [&](const SolveOption& entry) {
           return entry.group != OptionGroup::kRunning && CommandLineName(entry) == option.get_name() &&
                  option.get_group() == GroupTitle(entry.group);
         });
}

// Options that say how a scene is read or solved have no place beside a solution.
void RefuseSceneOptions(const SceneArguments& arguments) {
  if (!arguments.app) return;
  for (const CLI::Option* option : arguments.app->get_options()) {
    const bool reads =
        option->get_group() == kSceneGroup || (arguments.reading.up && option->get_name() == "--up");
    if (option->count() > 0 && (reads || SaysHowToSolve(*option)))
      throw UsageError(
          fmt::format("{} says how a scene is {}, but '{}' is a solution; give the scene, or leave it out",
                      option->get_name(), reads ? "read" : "solved", arguments.scene));
  }
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
  DimScene(arguments.dims, scene);
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
  StoredSolve& stored = loaded.stored.emplace();
  stored.state = std::move(solution.state);
  stored.version = std::move(solution.version);
  stored.schema = solution.schema;
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

void TellWarnings(const LoadedScene& loaded) {
  if (loaded.stored) return;
  for (const std::string& warning : loaded.scene.warnings) Say(warning);
}

LoadedScene LoadScene(const SceneArguments& arguments) {
  LoadedScene loaded = LoadWithoutWarnings(arguments);
  TellWarnings(loaded);
  return loaded;
}

LoadedScene LoadWithoutWarnings(const SceneArguments& arguments) {
  SetThreadCount(arguments.threads);
  CheckOptions(arguments);
  const Stopwatch reading;
  std::error_code ignored;
  if (std::filesystem::exists(arguments.scene, ignored)) arguments.outputs.RefuseInput(arguments.scene);
  const bool is_solution = IsSolution(arguments.scene);
  if (is_solution) RefuseSceneOptions(arguments);
  LoadedScene loaded = is_solution ? LoadSolution(arguments.scene)
                                   : LoadedScene{std::make_unique<const Scene>(ReadChangedScene(arguments))};
  if (!is_solution) CheckDistances(arguments, loaded.scene);
  if (is_solution && !arguments.dims.empty()) {
    LoadedScene dimmed = DimSolution(arguments, std::move(loaded));
    dimmed.seconds = reading.Seconds();
    return dimmed;
  }
  loaded.seconds = reading.Seconds();
  return loaded;
}

}  // namespace penumbra
