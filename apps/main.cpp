// penumbra: computes the light in a scene of diffuse polygons, and shows it.
//
// Exit status: 0 done; 1 the input or the machine does not allow it; 2 the command line makes no sense; 130
// interrupted.

#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/messages.h"
#include "apps/mpi_processes.h"
#include "apps/output.h"
#include "apps/unknown_words.h"
#include "apps/version.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr int kInputStatus = 1, kUsageStatus = 2, kInterruptedStatus = 130;

constexpr const char* kFooter =
    "`penumbra COMMAND --help` lists the options of a command.\n"
    "\n"
    "SCENE is a Wavefront OBJ file or the name of a built-in scene; a file wins over a name. Lengths are in\n"
    "metres, radiosity, irradiance and emittance in W/m^2; Kd is reflectance, Ke emittance.\n"
    "\n"
    "Exit status: 0 done; 1 bad input, one line on standard error; 2 bad usage; 130 interrupted.";

int Fail(int status, const std::string& message) {
  Say(message);
  return status;
}

int Main(int argc, char** argv) {
  CLI::App program(
      "Penumbra computes the light in a scene of diffuse polygons, once, and shows it from anywhere.",
      "penumbra");
  program.set_version_flag("--version", VersionLine(), "Print the version and exit");
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.require_subcommand(1);
  program.footer(kFooter);
  program.get_formatter()->column_width(34);
  const std::vector<Command> commands = {
      AddSolveCommand(program),      AddRenderCommand(program), AddProbeCommand(program),
      AddFormFactorCommand(program), AddViewCommand(program),   AddExportCommand(program),
      AddDiffCommand(program),       AddInfoCommand(program),   AddScenesCommand(program),
      AddMethodsCommand(program),    AddGridCommand(program),   AddCompletionCommand(program),
      AddManualPageCommand(program)};
  try {
    try {
      program.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
      return program.exit(help_or_version);
    } catch (const CLI::ParseError& error) {
      const std::string unknown = UnknownWord(program, std::vector<std::string>(argv + 1, argv + argc));
      const std::string what = unknown.empty() ? error.what() : unknown;
      return Fail(kUsageStatus, fmt::format("penumbra: error: {}{} `penumbra --help`", what,
                                            what.ends_with('?') ? " See" : "; see"));
    }
    for (const Command& command : commands)
      if (command.app->parsed()) command.run();
    return 0;
  } catch (const UsageError& error) {
    return Fail(kUsageStatus, fmt::format("penumbra: error: {}", error.what()));
  } catch (const Interrupted& error) {
    return Fail(kInterruptedStatus, error.what());
  } catch (const InputError& error) {
    return Fail(kInputStatus, error.what());
  } catch (const std::bad_alloc&) {
    return Fail(
        kInputStatus,
        "penumbra: error: out of memory; ask for a larger --error, a larger --min-area or a smaller --size");
  } catch (const PipeClosed&) {
    return kInputStatus;
  } catch (const std::exception& error) {
    return Fail(kInputStatus, fmt::format("penumbra: error: {}", error.what()));
  }
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  penumbra::PrepareStreams();
  penumbra::MpiSession session(&argc, &argv);
  int status = penumbra::Main(argc, argv);
  if (!penumbra::OutputArrived() && status == 0) status = penumbra::kInputStatus;
  session.Finish(status);
  return status;
}
