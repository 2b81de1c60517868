// penumbra_guard [--update]: times a small fixed set of work against a loop that does not change, and warns
// where a ratio is a fifth above the committed one. Ratios of one run travel between machines better than
// seconds do.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "display/two_pass_display.h"
#include "mesh/pipeline/pipeline.h"
#include "solver/base/parallel.h"
#include "solver/scene/builtin_scenes.h"

namespace penumbra {
namespace {

constexpr double kWorse = 1.2;  // "when one worsens by a fifth"
constexpr int kRounds = 5;      // the least of so many, taken in turns, is what counts
constexpr const char* kBaseline = "experiments/guard/baseline.csv";

struct Work {
  std::string name;
  std::function<void()> prepare, run;  // only the latter is timed
};

// Seconds of processor time of one call: other work on the machine disturbs them less than it does a clock on
// the wall. All runs in one thread.
double ProcessorSeconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// Square roots, divisions and arc tangents, as in polygon form factors, over more numbers than fit a
// register.
double Calibrate() {
  constexpr int kNumbers = 4096, kTimes = 400;
  std::vector<double> number(kNumbers, 0.5);
  for (int k = 0; k < kTimes; ++k)
    for (int i = 0; i < kNumbers; ++i) {
      double& x = number[static_cast<std::size_t>(i)];
      x = std::atan2(std::sqrt(x + i % 7), 1 + x) + 1 / (2 + x * x);
    }
  double sum = 0;
  for (const double x : number) sum += x;
  return sum;
}

// The stages of one scene, each from what the one before it made.
std::vector<Work> Stages(const Scene& scene) {
  struct State {
    std::unique_ptr<Pipeline> pipeline;
    std::unique_ptr<TwoPassDisplay> display;
  };
  const auto state = std::make_shared<State>();
  PipelineOptions options;
  options.refine = RefineBy::kTransport;
  const Camera camera = scene.cameras.front();
  return {
      {"link and iterate", [=, &scene] { state->pipeline = std::make_unique<Pipeline>(scene, options); },
       [=] { state->pipeline->Solve({}); }},
      {"mesh and interpolants", [] {},
       [=] {
         state->pipeline->RefineLight({});
         state->pipeline->BuildMesh(MeshKind::kInterpolant, {});
       }},
      {"ten frames",
       [=, &scene] { state->display = std::make_unique<TwoPassDisplay>(scene, state->pipeline->mesh()); },
       [=] {
         for (int i = 0; i < 10; ++i) state->display->Render(camera, 640, 480);
       }},
  };
}

// The least seconds of each, the calibration first.
std::map<std::string, double> Ratios() {
  SetThreadCount(1);
  const Scene scene = *LoadBuiltinScene("cornell", {});
  const std::vector<Work> stages = Stages(scene);
  double calibration = std::numeric_limits<double>::infinity(), sink = 0;
  std::map<std::string, double> least;
  for (int round = 0; round < kRounds; ++round) {
    calibration = std::min(calibration, ProcessorSeconds([&] { sink += Calibrate(); }));
    for (const Work& work : stages) {
      work.prepare();
      const double seconds = ProcessorSeconds(work.run);
      const auto [at, fresh] = least.emplace(work.name, seconds);
      if (!fresh) at->second = std::min(at->second, seconds);
    }
  }
  if (!std::isfinite(sink)) fmt::print(stderr, "{}\n", sink);
  for (auto& [name, seconds] : least) seconds /= calibration;
  return least;
}

std::map<std::string, double> ReadBaseline() {
  std::map<std::string, double> ratios;
  std::ifstream file(kBaseline);
  for (std::string line; std::getline(file, line);) {
    const std::size_t comma = line.rfind(',');
    if (comma != std::string::npos && line != "work,ratio")
      ratios[line.substr(0, comma)] = std::stod(line.substr(comma + 1));
  }
  return ratios;
}

int Run(bool update) {
  const std::map<std::string, double> now = Ratios(), before = ReadBaseline();
  if (update) {
    std::ofstream file(kBaseline);
    file << "work,ratio\n";
    for (const auto& [name, ratio] : now) file << fmt::format("{},{:.3g}\n", name, ratio);
    return file.flush() ? 0 : 1;
  }
  for (const auto& [name, ratio] : now) {
    const auto known = before.find(name);
    if (known == before.end()) {
      fmt::print("{}: {:.3g} of the calibration loop; no baseline\n", name, ratio);
      continue;
    }
    const double change = ratio / known->second;
    fmt::print("{}{}: {:.3g} of the calibration loop, {:.2f} times the baseline\n",
               change > kWorse ? "warning: slower: " : "", name, ratio, change);
  }
  return 0;
}

}  // namespace
}  // namespace penumbra

int main(int argc, char** argv) {
  bool update = false;
  CLI::App app("Warns where a fixed set of work has become slower");
  app.add_flag("--update", update, "Take this run's ratios as the baseline");
  CLI11_PARSE(app, argc, argv);
  return penumbra::Run(update);
}
