// Stepping is solving: steps lead to what the pipeline gives in one go, and what was handed out never
// changes.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <new>
#include <string>
#include <thread>

#include "display/viewer/leaf_mesh.h"
#include "display/viewer/light_change.h"
#include "display/viewer/session_progress.h"
#include "display/viewer/solver_session.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

// Links alone refine.
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
  pipeline.RefineLight(ExecutionContext());
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
  pipeline.RefineLight(ExecutionContext());
  pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  pipeline.Measure(ExecutionContext());
  EXPECT_DOUBLE_EQ(session.snapshot()->measured->interpolant_error.p99,
                   pipeline.report().interpolant_error.p99);
  EXPECT_DOUBLE_EQ(session.snapshot()->measured->energy.emitted, pipeline.report().energy.emitted);
}

// Asked for another number of points it counts those, over the light and the mesh that there are.
TEST(SolverSession, MeasuresAnewAtAnotherNumberOfPoints) {
  const auto scene = viewer_test::ShadowScene();
  SolverSession session(scene, Loose());
  session.Converge();
  session.Measure();
  ASSERT_TRUE(Rest(session));
  const auto before = session.snapshot();
  for (const std::size_t points : {std::size_t{70}, std::size_t{0}}) {
    session.SetErrorPoints(points);
    session.Measure();
    session.Converge();  // is done already
    ASSERT_TRUE(Rest(session));
    PipelineOptions options = Loose();
    options.error_points = points;
    Pipeline pipeline(*scene, options);
    pipeline.Solve(ExecutionContext());
    pipeline.RefineLight(ExecutionContext());
    pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
    pipeline.Measure(ExecutionContext());
    const auto now = session.snapshot();
    EXPECT_EQ(now->light, before->light);
    ASSERT_TRUE(now->measured);
    const PipelineReport& report = *now->measured;
    EXPECT_EQ(report.interpolant_error.points, points);
    EXPECT_EQ(report.interpolant_error.p99, pipeline.report().interpolant_error.p99);
    EXPECT_EQ(report.whole_error.p99, pipeline.report().whole_error.p99);
    EXPECT_EQ(report.solution_error_estimate, pipeline.report().solution_error_estimate);
    EXPECT_EQ(report.unmet, pipeline.report().unmet);
  }
}

// A step that is measured and saved is the one that was shown, not what refining would make of it.
TEST(SolverSession, MeasuringLeavesAStepAsItIs) {
  PipelineOptions options = Loose();
  options.refine = RefineBy::kBoth;
  options.error = 0.02;
  SolverSession session(viewer_test::ShadowScene(), options);
  session.Iterate();
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));
  const auto step = session.snapshot();
  ASSERT_FALSE(step->converged);
  ASSERT_TRUE(step->Mesh(MeshKind::kInterpolant));
  std::size_t saved = 0;
  session.Save([&](const Pipeline& pipeline) { saved = pipeline.mesh().triangles.size(); });
  ASSERT_TRUE(Rest(session));
  ASSERT_TRUE(session.snapshot()->measured);
  EXPECT_EQ(session.snapshot()->light, step->light);
  EXPECT_EQ(session.snapshot()->Mesh(MeshKind::kInterpolant), step->Mesh(MeshKind::kInterpolant));
  EXPECT_EQ(saved, step->Mesh(MeshKind::kInterpolant)->mesh().triangles.size());
  // Once it has settled, they refine again.
  session.Converge();
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));
  EXPECT_GT(session.snapshot()->Mesh(MeshKind::kInterpolant)->mesh().triangles.size(), saved);
}

// The largest difference of two lights, relative to the largest irradiance.
double LightDifference(const RadiositySolution& a, const RadiositySolution& b) {
  if (a.irradiance.size() != b.irradiance.size()) return 1;
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < a.irradiance.size(); ++i) {
    worst = std::max(worst, (a.irradiance[i] - b.irradiance[i]).abs().maxCoeff());
    largest = std::max(largest, b.irradiance[i].maxCoeff());
  }
  return largest > 0 ? worst / largest : worst;
}

// A branch has the light of its pipeline, goes on to the same result to the last bit, and leaves the pipeline
// where it was.
TEST(PipelineBranch, GoesOnByItself) {
  const auto scene = viewer_test::ShadowScene();
  Pipeline whole(*scene, Loose());
  whole.Link({});
  whole.Iterate({});
  const std::unique_ptr<Pipeline> branch = whole.Branch();
  ASSERT_TRUE(branch);
  const RadiositySolution before = whole.solution();
  EXPECT_EQ(LightDifference(branch->solution(), before), 0);
  branch->Solve({});
  branch->RefineLight({});
  branch->BuildMesh(MeshKind::kInterpolant, {});
  EXPECT_EQ(LightDifference(whole.solution(), before), 0);
  whole.Solve({});
  whole.RefineLight({});
  whole.BuildMesh(MeshKind::kInterpolant, {});
  EXPECT_EQ(LightDifference(branch->solution(), whole.solution()), 0);
  EXPECT_EQ(branch->mesh().triangles.size(), whole.mesh().triangles.size());
  EXPECT_EQ(branch->report().iterations.size(), whole.report().iterations.size());
}

// Each sweep adds a bounce: over the same links the light of the floor never falls from sweep to sweep.
TEST(SolverSession, SmallStepsAreBounces) {
  const auto scene = viewer_test::ShadowScene();
  SolverSession session(scene, Loose());
  std::vector<std::string> names;
  double floor_before = 0;
  for (int i = 0; i < 200 && !session.snapshot()->complete; ++i) {
    session.Step();
    ASSERT_TRUE(Rest(session));
    ASSERT_EQ(session.status().message, "");
    const auto steps = session.steps();
    ASSERT_EQ(steps->size(), session.place()->step);
    if (names.size() < steps->size()) names.push_back(steps->back().name);
    const double floor = session.snapshot()->light->solution().irradiance[0].maxCoeff();
    if (names.back() == "sweep" && names[names.size() - 2] == "sweep") {
      EXPECT_GE(floor, floor_before * (1 - 1e-12));
    }
    floor_before = floor;
  }
  ASSERT_TRUE(session.snapshot()->complete);
  ASSERT_GE(names.size(), 6U);
  EXPECT_EQ(names[0], "link");
  EXPECT_EQ(names[1], "sweep");
  EXPECT_NE(std::find(names.begin(), names.end(), "split"), names.end());
  EXPECT_NE(std::find(names.begin(), names.end(), "correct"), names.end());
  EXPECT_EQ(names.back(), "interpolants");
  // They lead to the light of whole iterations: splitting met other light, within the error of the links.
  Pipeline pipeline(*scene, Loose());
  pipeline.Solve({});
  pipeline.RefineLight({});
  const double whole = pipeline.solution().irradiance[0].maxCoeff();
  EXPECT_NEAR(session.snapshot()->light->solution().irradiance[0].maxCoeff(), whole, Loose().error * whole);
}

// Going back shows what was, and from there the same steps follow once more.
TEST(SolverSession, GoesBackToAnyStepAndOn) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  std::vector<std::shared_ptr<const SolverPlace>> places;
  for (int i = 0; i < 6; ++i) {
    session.Step();
    ASSERT_TRUE(Rest(session));
    places.push_back(session.place());
  }
  const RadiositySolution last = session.snapshot()->light->solution();
  session.Return(places[2]);
  ASSERT_TRUE(Rest(session));
  EXPECT_EQ(session.snapshot()->light, places[2]->snapshot->light);
  EXPECT_EQ(session.place()->step, 3U);
  EXPECT_EQ(session.steps()->size(), 6U);  // what follows is still there
  for (int i = 3; i < 6; ++i) {
    session.Step();
    ASSERT_TRUE(Rest(session));
  }
  EXPECT_EQ(session.steps()->size(), 6U);
  EXPECT_EQ(LightDifference(session.snapshot()->light->solution(), last), 0);
}

// A method without copies shows what was as of a file, and begins anew from there.
TEST(SolverSession, GoesBackWithMethodsThatHaveNoCopies) {
  PipelineOptions options = Loose();
  options.solver = "progressive";
  SolverSession session(viewer_test::ShadowScene(), options);
  session.Iterate();
  ASSERT_TRUE(Rest(session));
  const auto place = session.place();
  for (int i = 0; i < 3; ++i) session.Iterate();
  ASSERT_TRUE(Rest(session));
  session.Return(place);
  ASSERT_TRUE(Rest(session));
  EXPECT_EQ(session.status().message, "");
  EXPECT_EQ(session.snapshot()->light, place->snapshot->light);
  session.Iterate();
  ASSERT_TRUE(Rest(session));
  EXPECT_TRUE(session.snapshot()->light);
}

// The light of a lamp with a factor is the factor times its light; the light of a scene with other lamps and
// paints is that of a solve of that scene, within the error.
TEST(SolverSession, LightsChangedScenesOverTheKeptTransport) {
  const auto scene = viewer_test::ShadowScene();
  PipelineOptions options = Loose();
  options.refine = RefineBy::kBoth;
  options.error = 0.05;
  SolverSession session(scene, options);
  session.Converge();
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));
  const auto before = session.snapshot();
  LightChange change;
  const std::string lamp = LampsOf(*scene).at(0).name;
  change.Set(Dimming{lamp, Rgb(0.5, 0.25, 2)});
  session.SetLight(change);
  ASSERT_TRUE(Rest(session));
  ASSERT_EQ(session.status().message, "");
  const auto dimmed = session.snapshot();
  ASSERT_NE(dimmed->light, before->light);
  EXPECT_EQ(dimmed->opening, before->opening);
  const double cutoff = Resolve(*scene, options).solver.relative_cutoff;
  const IrradianceMesh &was = before->Mesh(MeshKind::kInterpolant)->mesh(),
                       &now = dimmed->Mesh(MeshKind::kInterpolant)->mesh();
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < was.irradiance.size(); ++i) {
    largest = std::max(largest, was.irradiance[i].f.maxCoeff());
    worst = std::max(worst, (now.irradiance[i].f - Rgb(0.5, 0.25, 2) * was.irradiance[i].f).abs().maxCoeff());
  }
  std::printf("dimming: error %.3g of the largest irradiance\n", worst / largest);
  EXPECT_LT(worst, (10 * cutoff + 0.5 * options.error) * largest);

  // A paint as well, against a solve of the changed scene.
  change.Set(
      Paint{scene->materials[static_cast<std::size_t>(scene->patches[0].material)].name, Rgb(0.2, 0.5, 0.3)});
  session.SetLight(change);
  ASSERT_TRUE(Rest(session));
  ASSERT_EQ(session.status().message, "");
  const Scene other = Changed(*scene, change);
  Pipeline fresh(other, options);
  fresh.Solve({});
  fresh.RefineLight({});
  const std::vector<Rgb>& lit = session.snapshot()->light->solution().irradiance;
  for (std::size_t p = 0; p < other.patches.size(); ++p)
    EXPECT_LE((lit[p] - fresh.solution().irradiance[p]).abs().maxCoeff(),
              options.error * std::max(fresh.solution().irradiance[p].maxCoeff(), 1e-9))
        << p;

  // And back, at once, to the very light of before.
  session.SetLight({});
  ASSERT_TRUE(Rest(session));
  EXPECT_EQ(session.snapshot()->light, before->light);
}

// What an iteration makes after lamps were dimmed is the solution of the dimmed scene.
TEST(SolverSession, SolvesTheChangedSceneAnew) {
  const auto scene = viewer_test::ShadowScene();
  SolverSession session(scene, Loose());
  LightChange change;
  change.Set(Dimming{LampsOf(*scene).at(0).name, Rgb(2, 1, 0.5)});
  session.SetLight(change);  // before anything is solved
  session.Converge();
  ASSERT_TRUE(Rest(session));
  const Scene other = Changed(*scene, change);
  Pipeline fresh(other, Loose());
  fresh.Solve({});
  EXPECT_LT(LightDifference(session.snapshot()->light->solution(), fresh.solution()), 1e-12);
}

// One number tells how far a solve is, and never falls.
TEST(SessionProgress, NeverFallsInASolve) {
  SessionProgress progress;
  double before = 0;
  const auto grows = [&] {
    EXPECT_GE(progress.fraction(), before);
    EXPECT_LT(progress.fraction(), 1);
    before = progress.fraction();
  };
  for (const SolveStage stage : {SolveStage::kLink, SolveStage::kIterate, SolveStage::kCorrect,
                                 SolveStage::kLight, SolveStage::kMesh, SolveStage::kMeasure}) {
    progress.Begin(stage);
    grows();
    for (int turn = 0; turn < 4; ++turn)
      for (const char* phase : {"refine sources", "discontinuities", "triangulate", "interpolate"})
        for (const double fraction : {0.0, 0.5, 1.0}) {
          progress.Report(phase, fraction);
          grows();
        }
  }
  progress.Begin(SolveStage::kLight);
  for (int i = 1; i <= 3; ++i) {
    progress.Report("refine sources", 0);
    progress.Report("interpolate", 0.5);
    EXPECT_EQ(progress.turn(), i);
  }
}

TEST(SolverSession, WhatHasConvergedStays) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  session.Converge();
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));
  const auto before = session.snapshot();
  session.Converge();
  ASSERT_TRUE(Rest(session));
  EXPECT_EQ(session.snapshot(), before);
}

// A limit holds for the interpolants as it does for the solve: they are not refined, or not even made.
TEST(SolverSession, LimitsHoldForTheMesh) {
  PipelineOptions options = Loose();
  options.refine = RefineBy::kBoth;
  options.error = 1e-3;
  options.time_limit = 1e-9;
  SolverSession session(viewer_test::ShadowScene(), options);
  session.Link();
  session.Iterate();
  for (int i = 0; i < 10; ++i) session.Correct();
  session.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(session));
  EXPECT_FALSE(session.snapshot()->Mesh(MeshKind::kInterpolant));
  EXPECT_TRUE(session.snapshot()->Mesh(MeshKind::kFlat));
}

// What the window shows is what `solve` makes: sources and mesh refined by what is shown, the same numbers.
TEST(SolverSession, RefinesByWhatIsShown) {
  const auto scene = viewer_test::ShadowScene();
  PipelineOptions options = Loose();
  options.refine = RefineBy::kBoth;
  options.error = 0.02;
  SolverSession session(scene, options);
  session.Converge();
  session.BuildMesh(MeshKind::kInterpolant);
  session.Measure();
  ASSERT_TRUE(Rest(session));
  Pipeline pipeline(*scene, options);
  pipeline.Solve(ExecutionContext());
  pipeline.RefineLight(ExecutionContext());
  pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  pipeline.Measure(ExecutionContext());
  const auto snapshot = session.snapshot();
  const IrradianceMesh& mesh = snapshot->Mesh(MeshKind::kInterpolant)->mesh();
  ASSERT_EQ(mesh.triangles.size(), pipeline.mesh().triangles.size());
  for (std::size_t i = 0; i < mesh.irradiance.size(); ++i)
    ASSERT_TRUE((mesh.irradiance[i].f == pipeline.mesh().irradiance[i].f).all()) << i;
  EXPECT_EQ(snapshot->light->solution().irradiance.size(), pipeline.solution().irradiance.size());
  EXPECT_EQ(snapshot->measured->whole_error.p99, pipeline.report().whole_error.p99);
  EXPECT_TRUE(snapshot->converged);
  // What links alone refine is coarser.
  Pipeline transport(*scene, [&] {
    PipelineOptions other = options;
    other.refine = RefineBy::kTransport;
    return other;
  }());
  transport.Solve(ExecutionContext());
  transport.RefineLight(ExecutionContext());
  transport.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  EXPECT_GT(mesh.triangles.size(), transport.mesh().triangles.size());
}

// A solution that is opened shows at once what was saved, and a step begins anew.
TEST(SolverSession, ShowsWhatAnotherSolved) {
  const auto scene = viewer_test::ShadowScene();
  Pipeline pipeline(*scene, Loose());
  pipeline.Solve(ExecutionContext());
  pipeline.RefineLight(ExecutionContext());
  pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
  pipeline.Measure(ExecutionContext());
  OpenedScene opened(scene);
  opened.solving = Loose();
  opened.stored = std::make_shared<PipelineState>(PipelineState{pipeline.visibility(), pipeline.solution(),
                                                                MeshKind::kInterpolant, pipeline.mesh(),
                                                                pipeline.report()});
  SolverSession session(opened, PipelineOptions());
  ASSERT_TRUE(Rest(session));
  const auto shown = session.snapshot();
  EXPECT_EQ(session.options().error, Loose().error);
  EXPECT_EQ(shown->Mesh(MeshKind::kInterpolant)->mesh().triangles.size(), pipeline.mesh().triangles.size());
  EXPECT_EQ(shown->light->solution().irradiance.size(), pipeline.solution().irradiance.size());
  EXPECT_TRUE(shown->converged);
  ASSERT_TRUE(shown->measured);
  const Pipeline* saved = nullptr;
  session.Save([&](const Pipeline& it) { saved = &it; });
  session.BuildMesh(MeshKind::kGouraudMesh);
  ASSERT_TRUE(Rest(session));
  EXPECT_NE(saved, nullptr);
  EXPECT_EQ(session.status().message, "");
  session.SetErrorPoints(7);
  session.Measure();
  ASSERT_TRUE(Rest(session));
  EXPECT_NE(session.status().message, "");
  EXPECT_EQ(session.snapshot()->measured->interpolant_error.points, Loose().error_points);
  EXPECT_TRUE(session.snapshot()->Mesh(MeshKind::kGouraudMesh));
  session.Converge();
  ASSERT_TRUE(Rest(session));
  EXPECT_FALSE(session.snapshot()->measured);
  EXPECT_EQ(session.snapshot()->light->solution().forest.size(), pipeline.solution().forest.size());
}

// A dense system has no iterations, its light stays whatever is shown of it, and a time limit ends a solve
// with a word.
TEST(SolverSession, SolvesDenseSystemsAndKeepsLimits) {
  const auto scene = viewer_test::ShadowScene();
  PipelineOptions options = Loose();
  options.solver = "dense";
  options.refine = RefineBy::kBoth;
  SolverSession dense(scene, options);
  dense.Converge();
  dense.Iterate();
  dense.Correct();
  ASSERT_TRUE(Rest(dense));
  const std::vector<Rgb> solved = dense.snapshot()->light->solution().irradiance;
  dense.BuildMesh(MeshKind::kInterpolant);
  ASSERT_TRUE(Rest(dense));
  const std::vector<Rgb>& shown = dense.snapshot()->light->solution().irradiance;
  ASSERT_EQ(shown.size(), solved.size());
  for (std::size_t e = 0; e < solved.size(); ++e) EXPECT_TRUE((shown[e] == solved[e]).all()) << e;
  EXPECT_TRUE(dense.snapshot()->Mesh(MeshKind::kInterpolant));
  EXPECT_TRUE(dense.snapshot()->iterations.empty());
  // Steps that a dense system does not have leave its mesh, which can be saved.
  dense.Correct();
  std::optional<MeshKind> saved;
  dense.Save([&](const Pipeline& pipeline) { saved = pipeline.mesh_kind(); });
  ASSERT_TRUE(Rest(dense));
  EXPECT_EQ(saved, MeshKind::kInterpolant);

  options = Loose();
  options.error = 1e-4;
  options.time_limit = 0.05;
  SolverSession limited(scene, options);
  limited.Converge();
  ASSERT_TRUE(Rest(limited));
  EXPECT_NE(limited.status().message.find("time"), std::string::npos) << limited.status().message;
}

TEST(SolverSession, SavesNothingUnsolved) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  session.Save([](const Pipeline&) { FAIL(); });
  ASSERT_TRUE(Rest(session));
  EXPECT_NE(session.status().message, "");
}

// Where memory ends while a picture is drawn, no other solution is asked for.
TEST(SolverSession, TellsWhatTheMemoryWasFor) {
  SolverSession session(viewer_test::ShadowScene(), Loose());
  session.Run("render", [](const Snapshot&, const ExecutionContext&) { throw std::bad_alloc(); });
  ASSERT_TRUE(Rest(session));
  EXPECT_NE(session.status().message.find("picture"), std::string::npos) << session.status().message;
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
