// The pipeline step by step.

#include "mesh/pipeline/pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "mesh/pipeline/thesis_options.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/transport/links/push_pull.h"
#include "solver/transport/solvers/light_solvers.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

Scene FurnishedRoom() {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), lamp = AddMaterial(scene, 0, 40);
  AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, grey);
  AddBox(scene, {1, 1, 0}, {2, 2, 1}, false, grey);
  Add(scene, {{2.5, 1, 2.25}, {2.5, 2, 2.25}, {3.5, 2, 2.25}, {3.5, 1, 2.25}}, lamp);
  return scene;
}

bool SameLight(const RadiositySolution& a, const RadiositySolution& b) {
  return a.radiosity.size() == b.radiosity.size() &&
         std::memcmp(a.radiosity.data(), b.radiosity.data(), a.radiosity.size() * sizeof(Rgb)) == 0;
}

// Steps lead where Solve() leads, to the byte; counts and iterations are told after each, and a mesh can be
// made at any time from the solution as it is then.
TEST(Pipeline, StepByStepIsTheSame) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.2;
  const ExecutionContext context;
  Pipeline whole(scene, options), steps(scene, options);
  whole.Solve(context);
  steps.Link(context);
  EXPECT_EQ(steps.solution().forest.size(), scene.patches.size());
  EXPECT_EQ(steps.report().counts.links, steps.solution().links.links.size());
  while (!steps.Converged()) {
    const std::optional<IterationReport> report = steps.Iterate(context);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->links, steps.report().counts.links);
    EXPECT_EQ(report->elements, steps.report().counts.elements);
  }
  steps.BuildMesh(MeshKind::kGouraud, context);
  EXPECT_FALSE(steps.mesh().triangles.empty());
  EXPECT_TRUE(steps.Correct(context));
  EXPECT_TRUE(SameLight(whole.solution(), steps.solution()));
  EXPECT_EQ(whole.report().iterations.size(), steps.report().iterations.size());
  EXPECT_TRUE(steps.report().unmet.empty());

  steps.BuildMesh(MeshKind::kGouraud, context);
  steps.Measure(context);
  EXPECT_GT(steps.report().interpolant_error.points, 0U);
}

// What a mesh or a measurement missed is told of the last one, once.
TEST(Pipeline, TellsWhatIsMissedOnce) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 1e-4;
  options.refine = RefineBy::kTransport;
  options.eps = 1;
  options.max_leaf_dsets = 0;
  options.error_points = 50;
  Pipeline pipeline(scene, options);
  pipeline.Link({});
  const auto lines = [&](const char* stage) {
    const std::vector<std::string>& unmet = pipeline.report().unmet;
    return std::count_if(unmet.begin(), unmet.end(),
                         [&](const std::string& line) { return line.starts_with(stage); });
  };
  for (int step = 0; step < 2; ++step) {
    ASSERT_TRUE(pipeline.Iterate({}));
    pipeline.BuildMesh(MeshKind::kInterpolant, {}, /*as_it_is=*/true);
    pipeline.Measure({});
    pipeline.Measure({});
    EXPECT_EQ(lines("discontinuities: "), 1) << step;
    EXPECT_EQ(lines("error: "), 1) << step;
  }
}

// A step that is cancelled leaves solution and report as they were, and the pipeline can go on.
TEST(Pipeline, CancelledStepsLeaveWhatWas) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.5;
  Pipeline pipeline(scene, options);
  const ExecutionContext running;
  ExecutionContext cancelled;
  cancelled.Cancel();
  ASSERT_TRUE(pipeline.Iterate(running));
  const RadiositySolution before = pipeline.solution();
  EXPECT_FALSE(pipeline.Iterate(cancelled));
  EXPECT_FALSE(pipeline.Correct(cancelled));
  EXPECT_FALSE(pipeline.Relight(cancelled));
  EXPECT_TRUE(SameLight(before, pipeline.solution()));
  EXPECT_EQ(pipeline.report().iterations.size(), 1U);
  EXPECT_EQ(pipeline.report().counts.elements, before.forest.size());
  pipeline.Solve(running);
  EXPECT_TRUE(pipeline.Converged());
}

// The light that a dense system was solved for is a reference: what is shown of it refines the mesh alone. So
// does what links alone refine, and what is corrected by parts of leaves.
TEST(Pipeline, MeshesLeaveReferencesAsTheyAre) {
  const Scene scene = FurnishedRoom();
  for (const int kind : {0, 1, 2}) {
    PipelineOptions options;
    options.error = 0.2;
    options.error_points = 20;
    if (kind == 0) options.solver = "dense";
    options.dense = {.divisions = 1, .tolerance = 0.01, .max_points = 100};
    if (kind == 1) options.refine = RefineBy::kTransport;
    if (kind == 2) options.source_error = 0.2;
    Pipeline pipeline(scene, options);
    pipeline.Solve({});
    EXPECT_FALSE(pipeline.RefinesLight());
    const RadiositySolution before = pipeline.solution();
    pipeline.RefineLight({});
    EXPECT_TRUE(SameLight(before, pipeline.solution())) << kind;
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    EXPECT_TRUE(SameLight(before, pipeline.solution())) << kind;
    pipeline.Measure({});
    EXPECT_TRUE(SameLight(before, pipeline.solution())) << kind;
    EXPECT_GT(pipeline.mesh().triangles.size(), before.forest.AllLeaves().size());
  }
}

// Interpolants are the same whichever mesh was made of the refined light before them.
TEST(Pipeline, InterpolantsDoNotDependOnEarlierMeshes) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.5;
  Pipeline straight(scene, options), detour(scene, options);
  for (Pipeline* pipeline : {&straight, &detour}) {
    pipeline->Solve({});
    pipeline->RefineLight({});
    if (pipeline == &detour) pipeline->BuildMesh(MeshKind::kGouraud, {});
    pipeline->BuildMesh(MeshKind::kInterpolant, {});
  }
  EXPECT_TRUE(SameLight(straight.solution(), detour.solution()));
  ASSERT_EQ(straight.mesh().triangles.size(), detour.mesh().triangles.size());
  for (std::size_t t = 0; t < straight.mesh().triangles.size(); ++t)
    EXPECT_TRUE(
        (straight.mesh().irradiance[t].At(0.25, 0.25) == detour.mesh().irradiance[t].At(0.25, 0.25)).all());
}

// After the materials were changed twice, solving goes on from the new light: it judges links by it.
TEST(Pipeline, SolvesOnAfterRelighting) {
  Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.5;
  options.max_iterations = 20;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  const std::size_t links = pipeline.report().counts.links;
  for (const double emittance : {80.0, 160.0}) {
    for (Material& material : scene.materials)
      if (material.emittance.maxCoeff() > 0) material.emittance = Rgb::Constant(emittance);
    ASSERT_TRUE(pipeline.Relight({}));
    EXPECT_EQ(pipeline.NextStep(), SolverStep::kIterate);
  }
  pipeline.Solve({});
  EXPECT_TRUE(pipeline.Converged());
  EXPECT_GT(pipeline.report().counts.links, links);
}

// A solver of the user's own: one step, which lights every patch by its lamps alone, with their mean
// radiosity as if they filled a tenth of its view.
class LampSolver final : public LightSolver {
 public:
  LampSolver(const Scene& scene, const PatchVisibility& visibility) : visibility_(visibility) {
    solution_.forest = ElementForest(scene);
    const PushPull dark(solution_);
  }
  bool Ready() const override { return true; }
  std::optional<SolverStep> Next() const override {
    return Converged() ? std::nullopt : std::optional(SolverStep::kIterate);
  }
  bool Step(SolverStep step, const ExecutionContext& context) override {
    if (step != SolverStep::kIterate || context.Cancelled()) return false;
    constexpr double kOfView = 0.1;
    const Scene& scene = solution_.forest.scene();
    Rgb lamps = Rgb::Zero();
    for (const Material& material : scene.materials) lamps = lamps.max(material.emittance);
    PushPull light(solution_);
    for (const ElementId leaf : light.leaves()) light.Light(leaf, kOfView * lamps);
    report_.iterations.emplace_back().elements = solution_.forest.size();
    return true;
  }
  bool Converged() const override { return !report_.iterations.empty(); }
  const RadiositySolution& solution() const override { return solution_; }
  const SolverReport& report() const override { return report_; }
  bool Relight(const ExecutionContext&) override { return false; }
  bool TakesLight() const override { return false; }
  bool SetLight(std::span<const Rgb>, std::vector<Fragment>, const ExecutionContext&) override {
    return false;
  }
  double PartOfTolerance() const override { return 1; }
  std::shared_ptr<const LeafVisibility> SeenFromLeaves(const ExecutionContext& context) override {
    return std::make_shared<const LeafVisibility>(solution_.forest, visibility_, context);
  }
  std::vector<Rgb> MeanIrradianceByBounce(int) const override { return {}; }

 private:
  const PatchVisibility& visibility_;
  RadiositySolution solution_;
  SolverReport report_;
};

// Another solver needs a class and an entry in the registry; pipeline, mesh and measurement take its light.
TEST(Pipeline, TakesAnySolver) {
  LightSolvers().Add({"lamps",
                      "lamps alone",
                      {},
                      [](const SolverScene& in, const LightSolverOptions&, const ExecutionContext& context) {
                        return std::make_unique<LampSolver>(in.scene, in.pairs(context));
                      }});
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.solver = "lamps";
  options.error = 0.5;
  options.error_points = 50;
  Pipeline pipeline(scene, options);
  std::vector<SolverStep> steps;
  pipeline.Solve({}, [&](SolverStep step) { steps.push_back(step); });
  EXPECT_EQ(steps, std::vector{SolverStep::kIterate});
  EXPECT_FALSE(pipeline.RefinesLight());
  const RadiositySolution solved = pipeline.solution();
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  pipeline.Measure({});
  EXPECT_TRUE(SameLight(solved, pipeline.solution()));
  EXPECT_GT(pipeline.mesh().triangles.size(), scene.patches.size());
  EXPECT_GT(pipeline.report().interpolant_error.points, 0U);
}

// Corrections that are cancelled on their way keep the passes that were made, and nothing that was made of
// the light before them.
TEST(Pipeline, CancelledCorrectionsKeepWholePasses) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.5;
  options.refine = RefineBy::kTransport;
  Pipeline pipeline(scene, options);
  ASSERT_TRUE(pipeline.Iterate(ExecutionContext()));
  const RadiositySolution before = pipeline.solution();
  pipeline.BuildMesh(MeshKind::kFlat, {});
  ReceiverPoint at;
  at.position = Vec3(3, 2, 0.5);  // in the free part of the room
  at.normal = Vec3::UnitZ();
  pipeline.irradiance();
  ExecutionContext* running = nullptr;
  ExecutionContext stops([&](std::string_view phase, double fraction) {
    if (phase == "correct" && fraction > 0) running->Cancel();
  });
  running = &stops;
  EXPECT_FALSE(pipeline.Correct(stops));
  EXPECT_FALSE(SameLight(before, pipeline.solution()));
  EXPECT_FALSE(pipeline.mesh_kind());
  const PointIrradiance fresh(pipeline.solution(), pipeline.visibility(), {});
  EXPECT_TRUE((pipeline.irradiance().Anywhere(at).irradiance == fresh.Anywhere(at).irradiance).all());
}

// Refinement asks for edges where it ranks them by errors and nobody named the least weight; what was named
// comes back as it is.
TEST(Resolve, WantsEdgesByErrorsAlone) {
  const Scene scene = *LoadBuiltinScene("floating-cube", {});
  const auto mesh = [&](const auto& change) {
    PipelineOptions options;
    change(options);
    return Resolve(scene, options).discontinuities;
  };
  const DiscontinuityOptions by_default = mesh([](PipelineOptions&) {});
  EXPECT_TRUE(by_default.can_want());
  EXPECT_LT(by_default.LeastWeight(), by_default.min_weight);
  EXPECT_FALSE(mesh([](PipelineOptions& o) { o.weight = DiscontinuityWeight::kThesis; }).can_want());
  EXPECT_FALSE(mesh([](PipelineOptions& o) { o.discontinuities = "adaptive"; }).can_want());
  const auto named = [](PipelineOptions& o) {
    o.weight = DiscontinuityWeight::kIrradiance;
    o.min_discontinuity_weight = 0.5;
  };
  EXPECT_FALSE(mesh(named).can_want());
  EXPECT_EQ(mesh(named).LeastWeight(), 0.5);
  const DiscontinuityOptions both = mesh([&](PipelineOptions& o) {
    named(o);
    o.min_wanted_weight = 0.2;
  });
  EXPECT_TRUE(both.can_want());
  EXPECT_EQ(both.min_weight, 0.5);
  EXPECT_EQ(both.min_wanted_weight, 0.2);
}

// A light meter that approaches a wall measures, in the limit, the wall's radiosity at its foot. At 1 and 3
// mm the foot fills all but 1e-5 and 1e-4 of what it sees.
TEST(Pipeline, PointsInSpaceBesideWalls) {
  const Scene scene = FurnishedRoom();
  PipelineOptions options;
  options.error = 0.05;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  double largest = 0, largest_of_leaves = 0;
  for (const Vec3& foot : {Vec3(0, 1.1, 1.3), Vec3(0, 2.03, 2.37), Vec3(4, 1.57, 2.1), Vec3(4, 0.3, 0.04)})
    for (const double height : {0.001, 0.003}) {
      const Vec3 out = foot.x() == 0 ? Vec3(1, 0, 0) : Vec3(-1, 0, 0);
      const double wall = 0.5 * pipeline.irradiance().Anywhere({foot, out, Vec3::Zero(), 0}).irradiance[0];
      const ReceiverPoint at{foot + height * out, -out, Vec3::Zero(), 0};
      const double measured = pipeline.IrradianceInSpace(pipeline.irradiance(), at).irradiance[0];
      largest = std::max(largest, std::abs(measured / wall - 1));
      largest_of_leaves =
          std::max(largest_of_leaves, std::abs(pipeline.irradiance().Anywhere(at).irradiance[0] / wall - 1));
    }
  std::printf("largest error %.4f of 0.05; of whole leaves %.4f\n", largest, largest_of_leaves);
  EXPECT_LE(largest, options.error);
  EXPECT_GT(largest_of_leaves, options.error);
}

// With the settings of the thesis, the office has about as many leaves and triangles as the office of the
// thesis (7.1): 1622 and 6576. The scenes differ, so that the numbers need not be the same.
TEST(Pipeline, AsInTheThesisTheOfficeHasTheSizeOfTheThesis) {
  const Scene scene = *LoadBuiltinScene("office", {});
  PipelineOptions options;
  SetAsThesis(true, &options);
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  const PipelineReport::Counts& counts = pipeline.report().counts;
  EXPECT_NEAR(static_cast<double>(counts.leaves), 1622, 0.05 * 1622);
  EXPECT_NEAR(static_cast<double>(counts.triangles), 6576, 0.15 * 6576);
  EXPECT_TRUE(pipeline.solution().fragments.empty());
  EXPECT_EQ(pipeline.resolved().solver.oracle, "thesis");
  EXPECT_EQ(pipeline.resolved().discontinuities.crowded_splits, 0);
}

}  // namespace
}  // namespace penumbra::scene_test
