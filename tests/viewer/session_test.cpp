// Stepping is solving: steps lead to what the pipeline gives in one go, and what was handed out never
// changes.

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "display/viewer/leaf_mesh.h"
#include "display/viewer/solver_session.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

// The session does not refine by what is shown.
PipelineOptions Loose() {
  PipelineOptions options = viewer_test::Options(false).solving;
  options.refine = RefineBy::kTransport;
  return options;
}

// Waits until the session rests; half a minute at most.
bool Rest(const SolverSession& session) {
  for (int i = 0; i < 30'000 && session.status().busy; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return !session.status().busy;
}

TEST(SolverSession, IsDarkBeforeItStarts) {
  const SolverSession session(viewer_test::ShadowScene(), Loose());
  const auto snapshot = session.snapshot();
  EXPECT_FALSE(snapshot->light);
  ASSERT_TRUE(snapshot->Mesh(MeshKind::kFlat));
  EXPECT_EQ(snapshot->Mesh(MeshKind::kFlat)->mesh().triangles.size(), 6U);
}

TEST(SolverSession, StepsLeadToThePipelinesSolution) {
  const auto scene = viewer_test::ShadowScene();
  SolverSession session(scene, Loose());
  session.Link();
  ASSERT_TRUE(Rest(session));
  ASSERT_TRUE(session.snapshot()->light);
  for (int i = 0; i < 50 && !session.snapshot()->converged; ++i) {
    session.Iterate();
    ASSERT_TRUE(Rest(session));
  }
  EXPECT_TRUE(session.snapshot()->converged);
  session.Converge();  // what is left are the corrections
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));

  Pipeline pipeline(*scene, Loose());
  pipeline.Solve(ExecutionContext());
  pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  const RadiositySolution& stepped = session.snapshot()->light->solution();
  ASSERT_EQ(stepped.forest.size(), pipeline.solution().forest.size());
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < stepped.forest.size(); ++i) {
    worst = std::max(worst, (stepped.irradiance[i] - pipeline.solution().irradiance[i]).abs().maxCoeff());
    largest = std::max(largest, stepped.irradiance[i].maxCoeff());
  }
  // One more round of sweeps moves the solution by no more than the cut-off.
  EXPECT_LE(worst, Resolve(*scene, Loose()).solver.relative_cutoff * largest);
  EXPECT_EQ(session.snapshot()->Mesh(MeshKind::kInterpolant)->mesh().triangles.size(),
            pipeline.mesh().triangles.size());
}

TEST(SolverSession, WhatWasHandedOutStays) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  session.Link();
  ASSERT_TRUE(Rest(session));
  const auto before = session.snapshot();
  const std::vector<Rgb> irradiance = before->light->solution().irradiance;
  session.Converge();
  ASSERT_TRUE(Rest(session));
  EXPECT_NE(session.snapshot(), before);
  ASSERT_EQ(before->light->solution().irradiance.size(), irradiance.size());
  for (std::size_t i = 0; i < irradiance.size(); ++i)
    EXPECT_TRUE((before->light->solution().irradiance[i] == irradiance[i]).all());
}

TEST(SolverSession, CanBeCancelledAnyTime) {
  for (const int microseconds : {0, 100, 1000, 5000, 20000}) {
    SolverSession session(viewer_test::ShadowScene(), Loose());
    session.Converge();
    session.BuildMesh(MeshKind::kInterpolant);
    session.Measure();
    std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
    session.Cancel();
    ASSERT_TRUE(Rest(session));
    ASSERT_TRUE(session.snapshot()->Mesh(MeshKind::kFlat));
    // It goes on from there.
    session.Converge();
    session.BuildMesh(MeshKind::kInterpolant);
    ASSERT_TRUE(Rest(session));
    EXPECT_TRUE(session.snapshot()->converged);
    EXPECT_TRUE(session.snapshot()->Mesh(MeshKind::kInterpolant));
  }
}

TEST(SolverSession, EndsWhileItWorks) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  session.Converge();
}

TEST(SolverSession, MeasuresWhatThePipelineMeasures) {
  const auto scene = viewer_test::ShadowScene();
  SolverSession session(scene, Loose());
  session.Converge();
  session.Measure();
  ASSERT_TRUE(Rest(session));
  ASSERT_TRUE(session.snapshot()->measured);
  Pipeline pipeline(*scene, Loose());
  pipeline.Solve(ExecutionContext());
  pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  pipeline.Measure(ExecutionContext());
  EXPECT_DOUBLE_EQ(session.snapshot()->measured->interpolant_error.p99,
                   pipeline.report().interpolant_error.p99);
  EXPECT_DOUBLE_EQ(session.snapshot()->measured->energy.emitted, pipeline.report().energy.emitted);
}

TEST(LeafMesh, CoversEveryPatch) {
  const auto scene = viewer_test::ShadowScene();
  ElementForest forest(*scene);
  forest.Subdivide(forest.Subdivide(0) + 2);  // not balanced
  const IrradianceMesh mesh = LeafMesh(forest, std::vector<Rgb>(forest.size(), Rgb::Zero()));
  double area = 0, whole = 0;
  for (const auto& t : mesh.triangles) {
    const std::array<Vec3, 3> v = {mesh.positions[t.vertex[0]], mesh.positions[t.vertex[1]],
                                   mesh.positions[t.vertex[2]]};
    area += VectorArea(v).dot(scene->patches[static_cast<std::size_t>(t.patch)].normal);
  }
  for (const Patch& patch : scene->patches) whole += patch.area;
  EXPECT_NEAR(area, whole, 1e-12 * whole);
}

}  // namespace
}  // namespace penumbra::viewer
