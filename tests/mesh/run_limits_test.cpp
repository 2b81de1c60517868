// Limits end a run, and say so.

#include "mesh/pipeline/run_limits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "mesh/pipeline/pipeline.h"
#include "solver/transport/solvers/hierarchical_solver.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra {
namespace {

// Without limits the context is the caller's own; with them it ends with that, in time, or by memory.
TEST(RunLimits, CancelWhatIsWatched) {
  const auto cancelled_soon = [](const RunLimits& limits) {
    for (int i = 0; i < 1000 && !limits.context().Cancelled(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return limits.context().Cancelled();
  };
  ExecutionContext outer;
  EXPECT_EQ(&RunLimits(outer, std::nullopt, std::nullopt).context(), &outer);
  const RunLimits generous(outer, 1e6, 1e15);
  EXPECT_FALSE(generous.context().Cancelled());
  const RunLimits late(outer, 0.001, std::nullopt), large(outer, std::nullopt, 1.0);
  EXPECT_TRUE(cancelled_soon(late));
  EXPECT_TRUE(cancelled_soon(large));
  EXPECT_TRUE(late.Exceeded() && large.Exceeded());
  EXPECT_FALSE(outer.Cancelled());
  outer.Cancel();
  EXPECT_TRUE(cancelled_soon(generous));
  EXPECT_FALSE(generous.Exceeded());
  EXPECT_GT(ResidentBytes(), std::uint64_t{1} << 20);
}

// A pipeline that meets a limit has a valid solution, of which a mesh can be made, and says what ended it.
TEST(RunLimits, EndASolveWithAValidSolution) {
  Random random(4001);
  const Scene scene = scene_test::FurnishedRoom(random, 4);
  PipelineOptions options;
  options.error = 0.001;
  options.error_points = 20;
  for (const bool memory : {false, true}) {
    options.time_limit = memory ? std::nullopt : std::optional(0.1);
    options.memory_limit = memory ? std::optional(1.0) : std::nullopt;
    Pipeline pipeline(scene, options);
    const ExecutionContext context;
    pipeline.Solve(context);
    EXPECT_FALSE(pipeline.Converged());
    ASSERT_EQ(pipeline.report().unmet.size(), 1U);
    EXPECT_NE(pipeline.report().unmet[0].find(memory ? "memory limit" : "time limit"), std::string::npos);
    EXPECT_EQ(pipeline.report().counts.links, pipeline.solution().links.links.size());
    pipeline.BuildMesh(MeshKind::kFlat, context);
    EXPECT_FALSE(pipeline.mesh().triangles.empty());
  }
}

// A limit that is reached before anything is linked leaves the scene dark but for its emitters, says so, and
// a mesh can be made of that, in no time; without the limit the same steps go on from there.
TEST(RunLimits, EndLinking) {
  Random random(4002);
  const Scene scene = scene_test::FurnishedRoom(random, 12);
  PipelineOptions options;
  options.error_points = 20;
  options.time_limit = 1e-6;
  Pipeline pipeline(scene, options);
  const ExecutionContext context;
  pipeline.Solve(context);
  ASSERT_EQ(pipeline.report().unmet.size(), 1U);
  EXPECT_NE(pipeline.report().unmet[0].find("link: ended by the time limit"), std::string::npos);
  EXPECT_TRUE(pipeline.solution().links.links.empty());
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    EXPECT_TRUE((pipeline.solution().irradiance[p] == 0).all());
    EXPECT_TRUE(
        (pipeline.solution().radiosity[p] == scene.MaterialOf(static_cast<PatchId>(p)).emittance).all());
  }
  // Interpolants need irradiance at points, for which there is no time.
  pipeline.RefineLight(context);
  pipeline.BuildMesh(MeshKind::kInterpolant, context);
  EXPECT_EQ(pipeline.mesh_kind(), MeshKind::kFlat);
  EXPECT_FALSE(pipeline.mesh().triangles.empty());
  EXPECT_NE(pipeline.report().unmet.back().find("mesh: ended by the time limit"), std::string::npos);
  pipeline.Measure(context);
  EXPECT_FALSE(pipeline.report().error_met);
  ASSERT_TRUE(pipeline.Iterate(context));
  EXPECT_FALSE(pipeline.solution().links.links.empty());
  EXPECT_TRUE((pipeline.solution().irradiance[0] > 0).all());
}

// Cancelled before it begins, linking leaves a solver without links, and visibility without pairs.
TEST(RunLimits, CancelledLinking) {
  Random random(4003);
  const Scene scene = scene_test::FurnishedRoom(random, 4);
  ExecutionContext cancelled;
  cancelled.Cancel();
  const PatchVisibility none(scene, cancelled), all(scene);
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    EXPECT_TRUE(none.SourcesOf(static_cast<PatchId>(p)).empty());
  HierarchicalSolver solver(scene, all, {}, cancelled);
  EXPECT_FALSE(solver.Ready());
  EXPECT_FALSE(solver.Next());
  EXPECT_TRUE(solver.solution().links.links.empty());
  EXPECT_EQ(solver.SeenFromLeaves(cancelled), nullptr);
  EXPECT_NE(solver.SeenFromLeaves(), nullptr);
  for (const bool dense : {false, true}) {
    PipelineOptions options;
    if (dense) options.solver = "dense";
    options.dense = {.divisions = 1, .tolerance = 0.01, .max_points = 100};
    Pipeline pipeline(scene, options);
    pipeline.Solve(cancelled);
    EXPECT_TRUE(pipeline.solution().links.links.empty());
    pipeline.Link(ExecutionContext());
    EXPECT_EQ(pipeline.solution().links.links.empty(), dense);
    EXPECT_EQ(pipeline.report().dense.has_value(), dense);
  }
}

// A room with so many boxes, in rows.
Scene RoomOfBoxes(int a_side) {
  Scene scene;
  const std::int32_t grey = scene_test::AddMaterial(scene, 0.6, 0),
                     lamp = scene_test::AddMaterial(scene, 0, 100);
  scene_test::AddBox(scene, Vec3::Zero(), Vec3::Constant(10), true, grey);
  scene_test::Add(scene, {{4, 4, 9.9}, {4, 6, 9.9}, {6, 6, 9.9}, {6, 4, 9.9}}, lamp);
  Random random(4005);
  const double step = 9.5 / a_side;
  for (int i = 0; i < a_side; ++i)
    for (int j = 0; j < a_side; ++j)
      for (int k = 0; k < a_side; ++k) {
        const Vec3 low(0.2 + i * step, 0.2 + j * step, 0.2 + k * step);
        const double size = random.Uniform(0.2, 0.6) * step;
        scene_test::AddBox(scene, low, low + Vec3::Constant(size), false, grey);
      }
  return scene;
}

// In a scene that takes minutes a limit ends whatever stage it meets, told with its name; what is there is
// shown and can be measured no more. What is left to do then takes some tenths of a second.
TEST(RunLimits, HoldInEveryStage) {
  constexpr double kBusyMachine = 3;  // [s] other tests run beside this one
  const Scene scene = RoomOfBoxes(8);
  for (const double limit : {0.05, 1.0, 3.0}) {
    PipelineOptions options;
    options.error = 0.1;
    options.time_limit = limit;
    const auto begin = RunLimits::Clock::now();
    Pipeline pipeline(scene, options);
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    pipeline.Measure({});
    const std::chrono::duration<double> took = RunLimits::Clock::now() - begin;
    std::printf("%zu patches, a limit of %.2f s: %.2f s\n", scene.patches.size(), limit, took.count());
    EXPECT_LE(took.count(), limit + kBusyMachine);
    EXPECT_FALSE(pipeline.report().error_met);
    ASSERT_FALSE(pipeline.report().unmet.empty());
    for (const std::string& line : pipeline.report().unmet)
      EXPECT_NE(line.find("ended by the time limit"), std::string::npos) << line;
    EXPECT_FALSE(pipeline.mesh().triangles.empty());
  }
}

}  // namespace
}  // namespace penumbra
