// Limits end a run, and say so.

#include "mesh/run_limits.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "mesh/pipeline.h"
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

}  // namespace
}  // namespace penumbra
