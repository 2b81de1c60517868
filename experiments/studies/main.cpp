// penumbra_study NAME|all [--quick] [-o FOLDER]: runs studies and writes, for each, FOLDER/NAME.csv with its
// rows and FOLDER/NAME.json with what it claims and what it found. `experiments/run` builds and calls it.

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include <fmt/format.h>

#include "experiments/studies/study.h"
#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/stopwatch.h"

namespace penumbra {
namespace {

struct Arguments {
  std::string study = "all";
  std::filesystem::path folder = ".";
  std::string commit = "unknown";
  bool quick = false;
};

// What the processor calls itself, with the number of threads.
std::string Machine() {
  std::ifstream info("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  return fmt::format("{}, {} threads", name, ThreadCount());
}

std::string Quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string Number(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }
std::string Count(const std::optional<std::size_t>& count) {
  return count ? fmt::format("{}", *count) : std::string();
}

void WriteRows(const Study& study, const StudyLog& log, const Arguments& arguments,
               const std::string& machine) {
  std::ofstream file(arguments.folder / fmt::format("{}.csv", study.name));
  file << "study,scene,method,setting,parameter,seconds,error_rms,error_p95,error_p99,error_max,elements,"
          "links,triangles,evaluations,bytes,machine,commit\n";
  for (const StudyRow& row : log.rows())
    file << fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", study.name, Quoted(row.scene),
                        Quoted(row.method), Quoted(row.setting), Number(row.parameter), Number(row.seconds),
                        Number(row.error_rms), Number(row.error_p95), Number(row.error_p99),
                        Number(row.error_max), Count(row.elements), Count(row.links), Count(row.triangles),
                        Count(row.evaluations), Count(row.bytes), Quoted(machine), arguments.commit);
  if (!file.flush())
    throw InputError(fmt::format("{}:0: error: cannot be written", arguments.folder.string()));
}

void WriteFindings(const Study& study, const StudyLog& log, const Arguments& arguments,
                   const std::string& machine, double seconds) {
  nlohmann::ordered_json summary;
  summary["study"] = study.name;
  summary["title"] = study.title;
  summary["hypothesis"] = study.hypothesis;
  summary["x"] = study.x;
  summary["y"] = study.y;
  summary["findings"] = log.findings();
  summary["quick"] = arguments.quick;
  summary["seconds"] = std::round(seconds * 10) / 10;
  summary["machine"] = machine;
  summary["commit"] = arguments.commit;
  std::ofstream(arguments.folder / fmt::format("{}.json", study.name)) << summary.dump(2) << "\n";
}

int Run(const Arguments& arguments) {
  std::filesystem::create_directories(arguments.folder);
  const std::string machine = Machine();
  bool found = false;
  for (const Study* study : Studies()) {
    if (arguments.study != "all" && arguments.study != study->name) continue;
    found = true;
    fmt::print(stderr, "== {}: {}\n", study->name, study->title);
    StudyLog log(arguments.quick);
    const Stopwatch stopwatch;
    study->run(log);
    WriteRows(*study, log, arguments, machine);
    WriteFindings(*study, log, arguments, machine, stopwatch.Seconds());
  }
  if (found) return 0;
  fmt::print(stderr, "there is no study `{}`; there are all", arguments.study);
  for (const Study* study : Studies()) fmt::print(stderr, ", {}", study->name);
  fmt::print(stderr, "\n");
  return 2;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  penumbra::Arguments arguments;
  CLI::App app("Measures speed against error");
  app.add_option("study", arguments.study, "The study's name, or all")->capture_default_str();
  app.add_flag("--quick", arguments.quick, "Some seconds each: shows that they work");
  app.add_option("-o", arguments.folder, "Where the results go")->capture_default_str();
  app.add_option("--commit", arguments.commit, "The commit that is measured, for the results");
  CLI11_PARSE(app, argc, argv);
  try {
    return penumbra::Run(arguments);
  } catch (const penumbra::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
