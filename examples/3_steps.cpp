// Example 3: step the solver, and print what each step does.
//
//   example_3_steps [SCENE]

#include <fmt/format.h>

#include <optional>
#include <string>

#include "mesh/pipeline/pipeline.h"
#include "solver/base/check.h"
#include "solver/scene/named_scene.h"

using namespace penumbra;

namespace {

// The light that surfaces receive: irradiance times area, over all patches and channels [W].
double ReceivedFlux(const Scene& scene, const RadiositySolution& solution) {
  double flux = 0;
  for (std::size_t patch = 0; patch < scene.patches.size(); ++patch)
    flux += scene.patches[patch].area * solution.irradiance[patch].sum();  // element i is the root of patch i
  return flux;
}

void PrintRow(const Pipeline& pipeline, const std::string& step) {
  const PipelineReport::Counts& counts = pipeline.report().counts;
  fmt::print("{:<14} {:>8} {:>8} {:>8} {:>10.4f}\n", step, counts.elements, counts.links,
             counts.links_partial, ReceivedFlux(pipeline.scene(), pipeline.solution()));
}

}  // namespace

int main(int argc, char** argv) try {
  const Scene scene = ReadNamedScene(argc > 1 ? argv[1] : "floating-cube", SceneOptions());
  const ExecutionContext context;
  PipelineOptions options;
  options.error = 0.05;
  Pipeline pipeline(scene, options);
  fmt::print("{:<14} {:>8} {:>8} {:>8} {:>10}\n", "step", "elements", "links", "partial", "flux [W]");

  // 1. Link: find out which patches see each other, and link those that do. Nothing is lit yet but what
  //    emits. A link is partial if something may stand between its ends.
  pipeline.Link(context);
  PrintRow(pipeline, "link");

  // 2. Iterate: gather light along the links until it settles, then split the links whose error is too large.
  //    Each iteration leaves more elements and links, and a smaller residual.
  for (int i = 0; i < options.max_iterations && !pipeline.Converged(); ++i) {
    const std::optional<IterationReport> done = pipeline.Iterate(context);
    if (!done) break;  // cancelled
    PrintRow(pipeline, fmt::format("iterate {}", i + 1));
    fmt::print("    {} sweeps, {} links split, residual {:.1e}\n", done->sweeps, done->links_split,
               done->residual);
  }

  // 3. Correct: replace the irradiance of each leaf by its exact value, and send what changes along the
  // links.
  pipeline.Correct(context);
  PrintRow(pipeline, "correct");

  // 4. Build the mesh: find the lines where shadows begin and end, triangulate, and fit the interpolants.
  //    Before that, a first mesh refines the light, until the error that was asked for is met.
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);
  PrintRow(pipeline, "build mesh");
  const PipelineReport::Counts& counts = pipeline.report().counts;
  fmt::print("    {} discontinuities found, {} triangles\n", counts.discontinuities, counts.triangles);

  // 5. Measure: does the energy balance, and how far are interpolants from exact irradiance?
  pipeline.Measure(context);
  const PipelineReport& report = pipeline.report();
  fmt::print("emitted {:.1f} W, absorbed {:.1f} W, escaped {:.1f} W, imbalance {:.1e}\n",
             report.energy.emitted, report.energy.absorbed, report.energy.escaped,
             report.energy.relative_imbalance);
  fmt::print("99 points in 100 err by at most {:.2f} %, {:.0f} % was asked for: {}\n",
             100 * report.whole_error.p99, 100 * options.error, report.error_met ? "met" : "missed");
  return report.error_met ? 0 : 1;
} catch (const InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 1;
}
