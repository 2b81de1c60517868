// Refinement by what is shown: sources out of interpolants, mesh leaves by measured errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <span>

#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "mesh/refinement/mesh_refinement.h"
#include "mesh/refinement/refinement_step.h"
#include "mesh/refinement/source_cells.h"
#include "solver/base/parallel.h"
#include "solver/scene/obj_reader.h"
#include "solver/scene/scene_parts.h"
#include "solver/scene/surface_points.h"
#include "solver/visibility/point/enclosure.h"
#include "test_paths.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra::scene_test {
namespace {

Scene Room() {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), lamp = AddMaterial(scene, 0, 40);
  AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, grey);
  AddBox(scene, {1, 1, 0}, {2, 2, 1}, false, grey);
  Add(scene, {{2.5, 1, 2.25}, {2.5, 2, 2.25}, {3.5, 2, 2.25}, {3.5, 1, 2.25}}, lamp);
  return scene;
}

PipelineOptions Options(double error) {
  PipelineOptions options;
  options.error = error;
  options.error_points = 500;
  return options;
}

// A solved room with a mesh, to look at piece by piece.
struct Solved {
  explicit Solved(double error) : scene(Room()), pipeline(scene, Transport(error)) {
    pipeline.Solve({});
    MeshReport report;
    triangulations = PatchTriangulator(pipeline.visibility(), pipeline.solution(), {}, {})
                         .Triangulate({pipeline.solution().forest, {}}, report);
    mesh = BuildIrradianceMesh(scene, triangulations, InterpolantOrder::kQuadratic, Sampler(), {}).mesh;
  }
  static PipelineOptions Transport(double error) {
    PipelineOptions options = Options(error);
    options.refine = RefineBy::kTransport;
    return options;
  }
  IrradianceSampler Sampler() {
    return
        [this](PatchId patch, const ReceiverPoint& at) { return pipeline.irradiance().OnPatch(patch, at); };
  }
  SourceCells Cells(double finest, std::span<const SourceCell> before = {}) {
    return {pipeline.solution(),
            {pipeline.solution().forest, triangulations, mesh},
            pipeline.irradiance(),
            {finest, before}};
  }

  Scene scene;
  Pipeline pipeline;
  std::vector<PatchTriangulation> triangulations;
  IrradianceMesh mesh;
};

// Cells tile the leaves and keep their mean, so that the light that leaves them is the same.
TEST(SourceCells, TileTheLeaves) {
  Solved solved(0.1);
  std::size_t before = 0;
  for (const double finest : {1.0, 0.2, 0.1, 0.05}) {
    const SourceCells cells = solved.Cells(finest);
    const std::vector<Rgb> mean = cells.LeafIrradiance();
    const std::vector<Fragment> fragments = cells.Fragments(true);
    EXPECT_GE(fragments.size(), before) << "a lower score is a finer division";
    before = fragments.size();
    std::map<ElementId, double> area;
    std::map<ElementId, Rgb> light;
    for (const Fragment& fragment : fragments) {
      area[fragment.leaf] += VectorArea(fragment.polygon).norm();
      const Rgb light_here = fragment.area * fragment.irradiance;
      light.try_emplace(fragment.leaf, Rgb::Zero()).first->second += light_here;
    }
    for (const auto& [leaf, sum] : area) {
      const double whole = solved.pipeline.solution().forest[leaf].area;
      EXPECT_NEAR(sum, whole, 1e-9 * whole);
      const Rgb& want = mean[static_cast<std::size_t>(leaf)];
      EXPECT_LE((light[leaf] / whole - want).abs().maxCoeff(), 1e-9 * want.maxCoeff() + 1e-12);
    }
  }
  EXPECT_GT(before, solved.pipeline.solution().forest.AllLeaves().size());
}

// The means over the leaves are those of the mesh: the areas of triangles times the means of their
// interpolants, whatever the cells.
TEST(SourceCells, HaveTheMeansOfTheMesh) {
  Solved solved(0.1);
  const std::vector<Rgb> mean = solved.Cells(0.05).LeafIrradiance();
  std::vector<Rgb> sum(mean.size(), Rgb::Zero());
  std::size_t t = 0;
  for (const PatchTriangulation& patch : solved.triangulations)
    for (std::size_t leaf = 0; leaf < patch.leaves.size(); ++leaf)
      for (std::uint32_t i = patch.first_triangle[leaf]; i < patch.first_triangle[leaf + 1]; ++i, ++t) {
        std::array<Vec3, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
          corner[k] = solved.mesh.positions[solved.mesh.triangles[t].vertex[k]];
        const QuadraticInterpolant& q = solved.mesh.irradiance[t];
        sum[static_cast<std::size_t>(patch.leaves[leaf])] +=
            VectorArea(corner).norm() * (q.At(0.5, 0) + q.At(0.5, 0.5) + q.At(0, 0.5)) / 3;
      }
  // Interpolants that dip below zero are cut off there, cell by cell.
  constexpr double kCutOff = 1e-3;
  double worst = 0;
  for (const ElementId leaf : solved.pipeline.solution().forest.AllLeaves()) {
    const Element& element = solved.pipeline.solution().forest[leaf];
    if ((solved.scene.MaterialOf(element.patch).reflectance == 0).all()) continue;
    const Rgb want = sum[static_cast<std::size_t>(leaf)] / element.area;
    if (want.maxCoeff() <= 0) continue;
    worst = std::max(worst, (mean[static_cast<std::size_t>(leaf)] - want).abs().maxCoeff() / want.maxCoeff());
  }
  std::printf("largest difference %.2g\n", worst);
  EXPECT_LE(worst, kCutOff);
}

// Cells that were divided stay divided, so that what is known about them stays valid: a map of nodes finds
// each of them in the later set.
TEST(SourceCells, OnlyGrow) {
  Solved solved(0.1);
  const SourceCells fine = solved.Cells(0.05), coarse = solved.Cells(0.2),
                    kept = solved.Cells(0.2, fine.cells());
  EXPECT_LT(coarse.cells().size(), fine.cells().size());
  ASSERT_EQ(kept.cells().size(), fine.cells().size());
  for (std::size_t i = 0; i < kept.cells().size(); ++i)
    EXPECT_TRUE(kept.cells()[i].polygon == fine.cells()[i].polygon);
  const RadiositySolution& solution = solved.pipeline.solution();
  const SourceSet from = SourceSet::FromSolution(solution, coarse.Fragments(false)),
                  to = SourceSet::FromSolution(solution, fine.Fragments(false));
  const std::vector<std::int32_t> map = MapNodes(from, to);
  for (std::size_t i = 0; i < map.size(); ++i) {
    ASSERT_GE(map[i], 0);
    const SourceSet::Node &a = from.NodeAt(i), &b = to.NodeAt(static_cast<std::size_t>(map[i]));
    ASSERT_EQ(a.size, b.size);
    for (std::size_t k = 0; k < static_cast<std::size_t>(a.size); ++k) EXPECT_EQ(a.vertex[k], b.vertex[k]);
  }
  const std::vector<std::int32_t> back = MapNodes(to, from);
  EXPECT_GT(std::count(back.begin(), back.end(), -1), 0) << "the finest nodes are not in the coarse set";
}

// Quartered cells are subtrees of the source set again: every node's parts tile it, and each fragment is
// there once.
TEST(SourceCells, QuartersHangTogether) {
  Solved solved(0.1);
  const SourceCells cells = solved.Cells(0.02);
  const std::vector<Fragment> fragments = cells.Fragments(true);
  const SourceSet set = SourceSet::FromSolution(solved.pipeline.solution(), fragments);
  constexpr double kRounding = 1e-12;  // of an area: sums of some hundred products of coordinates
  std::set<std::int32_t> known;
  std::int32_t last = -1;
  int quartered = 0;
  double worst = 0;
  for (std::size_t p = 0; p < solved.scene.patches.size(); ++p) {
    const std::span<const SourceSet::Node> tree = set.Tree(static_cast<PatchId>(p));
    for (std::size_t i = 0; i < tree.size(); ++i) {
      const SourceSet::Node& node = tree[i];
      if (node.fragment >= 0 && node.fragment != last) {
        last = node.fragment;
        EXPECT_TRUE(known.insert(last).second) << last;
      }
      if (node.skip == 1) continue;
      double parts = 0;
      const std::size_t end = i + static_cast<std::size_t>(node.skip);
      for (std::size_t k = i + 1; k < end; k += static_cast<std::size_t>(tree[k].skip)) parts += tree[k].area;
      worst = std::max(worst, std::abs(parts / node.area - 1));
      ++quartered;
    }
  }
  const RadiositySolution& solution = solved.pipeline.solution();
  const auto bright = std::count_if(fragments.begin(), fragments.end(), [&](const Fragment& fragment) {
    return !set.Tree(solution.forest[fragment.leaf].patch).empty();  // that of a black patch is
  });
  EXPECT_EQ(known.size(), static_cast<std::size_t>(bright));
  EXPECT_GT(quartered, 10);
  std::printf("%zu fragments, %d quartered nodes, largest difference %.2g\n", fragments.size(), quartered,
              worst);
  EXPECT_LE(worst, kRounding);
}

// The error that is asked for is the error that comes out, for the whole light, at points that were not used
// before; and no less by far.
TEST(Refinement, ReachesTheErrorAskedFor) {
  const Scene scene = Room();
  for (const double error : {0.1, 0.03}) {
    Pipeline pipeline(scene, Options(error));
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    pipeline.Measure({});
    const PipelineReport& report = pipeline.report();
    std::printf("asked %.3g: interpolants %.3g, sources %.3g, whole %.3g; %zu triangles, %zu evaluations\n",
                error, report.interpolant_error.p99, report.solution_error_estimate, report.whole_error.p99,
                report.counts.triangles, report.counts.point_evaluations);
    EXPECT_TRUE(report.error_met);
    EXPECT_LE(report.whole_error.p99, error);
    EXPECT_EQ(pipeline.triangle_errors().size(), pipeline.mesh().triangles.size());
  }
}

// Sources seen as one leave out no more than they may, at either sign: what they make of the mean is much
// less. The tolerances of errors of 0.025, 0.05 and 0.1.
TEST(Refinement, SourcesSeenAsOneCostLittle) {
  const Scene scene = Room();
  Pipeline pipeline(scene, Options(0.05));
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  ASSERT_FALSE(pipeline.solution().fragments.empty());
  constexpr std::size_t kPoints = 1000;
  const std::vector<SurfacePoint> points = SpreadPoints(scene, kPoints, 11);
  for (const double tolerance : {0.005, 0.01, 0.02}) {
    std::vector<Rgb> near, exact;
    Rgb near_sum = Rgb::Zero(), sum = Rgb::Zero();
    for (const SurfacePoint& p : points) {
      ReceiverPoint at;
      at.position = p.position;
      at.normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
      near.push_back(pipeline.irradiance().NearlyOnPatch(p.patch, at, tolerance).irradiance);
      exact.push_back(pipeline.irradiance().OnPatch(p.patch, at).irradiance);
      near_sum += near.back();
      sum += exact.back();
    }
    const double p99 = Quantile(RelativeErrors(near, exact), 0.99), mean = (near_sum / sum - 1)[0];
    std::printf("tolerance %.3g: p99 %.2g, mean off by %.2g\n", tolerance, p99, mean);
    EXPECT_GT(p99, 0.0);
    EXPECT_LE(p99, tolerance);
    EXPECT_LE(std::abs(mean), 0.25 * tolerance);
  }
}

// A hut on the floor of a room, with a slit under one wall.
Scene Hut() {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), lamp = AddMaterial(scene, 0, 40);
  AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, grey);
  AddBox(scene, {1, 1, 0}, {1.1, 2, 1}, false, grey);
  AddBox(scene, {1.9, 1, 0.05}, {2, 2, 1}, false, grey);
  AddBox(scene, {1, 0.9, 0}, {2, 1, 1}, false, grey);
  AddBox(scene, {1, 2, 0}, {2, 2.1, 1}, false, grey);
  AddBox(scene, {1, 0.9, 1}, {2, 2.1, 1.1}, false, grey);
  Add(scene, {{2.5, 1, 2.25}, {2.5, 2, 2.25}, {3.5, 2, 2.25}, {3.5, 1, 2.25}}, lamp);
  return scene;
}

// Where walls hide all that is bright, sources seen as one are judged beside the little light that arrives.
TEST(Refinement, SourcesSeenAsOneCostLittleInTheDark) {
  const Scene scene = Hut();
  Pipeline pipeline(scene, Options(0.05));
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  constexpr double kTolerances[] = {0.005, 0.01};  // of errors of 0.025 and 0.05
  std::vector<Rgb> near[2], exact;
  std::vector<bool> in_hut;
  for (const SurfacePoint& p : SpreadPoints(scene, 3000, 11)) {
    ReceiverPoint at;
    at.position = p.position;
    at.normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
    for (int k = 0; k < 2; ++k)
      near[k].push_back(pipeline.irradiance().NearlyOnPatch(p.patch, at, kTolerances[k]).irradiance);
    exact.push_back(pipeline.irradiance().OnPatch(p.patch, at).irradiance);
    constexpr double kSlack = 1e-9;
    in_hut.push_back(
        ((p.position - Vec3(1.5, 1.5, 0.5)).cwiseAbs().array() <= Eigen::Array3d(0.4, 0.5, 0.5) + kSlack)
            .all());
  }
  for (int k = 0; k < 2; ++k) {
    const std::vector<double> all = RelativeErrors(near[k], exact);
    std::vector<double> errors;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (in_hut[i / 3]) errors.push_back(all[i]);
    ASSERT_GE(errors.size(), 300U);
    const double p99 = Quantile(errors, 0.99);
    std::printf("tolerance %.3g: %zu values in the hut, p99 %.2g\n", kTolerances[k], errors.size(), p99);
    EXPECT_LE(p99, kTolerances[k]);
  }
}

// A block that stands near a wall: light goes to and fro between the two, the mean of what is there comes to
// rest only after many passes, and what is off in all samples adds up from wall to wall: at first this was
// told to be off by 2.5 %, and was off by 9 %.
TEST(Refinement, SettlesTheLightInASlot) {
  Scene scene;
  const std::int32_t white = AddMaterial(scene, 0.8, 0), lamp = AddMaterial(scene, 0, 40);
  AddBox(scene, Vec3::Zero(), {3, 3, 2.5}, true, white);
  AddBox(scene, {0.06, 0.6, 0}, {1, 2.4, 1.8}, false, white);
  Add(scene, {{1.5, 1, 2.4}, {1.5, 2, 2.4}, {2.5, 2, 2.4}, {2.5, 1, 2.4}}, lamp);
  constexpr double kError = 0.05;
  Pipeline pipeline(scene, Options(kError));
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  pipeline.Measure({});
  const PipelineReport& report = pipeline.report();
  std::printf("interpolants %.3g, sources %.3g, whole %.3g\n", report.interpolant_error.p99,
              report.solution_error_estimate, report.whole_error.p99);
  EXPECT_TRUE(report.error_met);
  EXPECT_LE(report.whole_error.p99, kError);

  constexpr double kFineError = 0.02;
  Pipeline fine(scene, Options(kFineError));
  fine.Solve({});
  fine.RefineLight({});
  fine.BuildMesh(MeshKind::kInterpolant, {});
  std::vector<Rgb> shown, better;
  for (const SurfacePoint& p : SpreadPoints(scene, 1000, 5)) {
    const std::optional<Rgb> interpolated = pipeline.Interpolated(p.patch, p.position);
    ASSERT_TRUE(interpolated);
    ReceiverPoint at;
    at.position = p.position;
    at.normal = scene.patches[static_cast<std::size_t>(p.patch)].normal;
    shown.push_back(*interpolated);
    better.push_back(fine.irradiance().OnPatch(p.patch, at).irradiance);
  }
  const double p99 = Quantile(RelativeErrors(shown, better), 0.99);
  std::printf("against a finer solution %.3g\n", p99);
  EXPECT_LE(p99, kError);
}

// Below a light in the ceiling triangles err by more than their centroids tell: random points see it, and the
// mesh is refined on.
TEST(Refinement, ReachesTheErrorThatCentroidsOverlook) {
  constexpr double kError = 0.05;
  const Scene scene = ReadObj(PENUMBRA_SOURCE_DIR "/experiments/peers/box.obj", {});
  PipelineOptions options = Options(kError);
  options.error_points = 4000;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.RefineLight({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  pipeline.Measure({});
  const PipelineReport& report = pipeline.report();
  std::printf("interpolants %.3g, whole %.3g\n", report.interpolant_error.p99, report.whole_error.p99);
  EXPECT_LE(report.interpolant_error.p99, kError);
  EXPECT_LE(report.whole_error.p99, kError);
}

// Dividing leaves for the mesh evaluates new nodes only, leaves the solution alone, and lowers the share of
// the area that errs.
// The shadow of a plate lies within the large triangles of an empty floor, away from their vertices and
// centres. The mesh of sampled light shows it without edges along discontinuities.
TEST(Refinement, FindsAShadowWithinALargeTriangle) {
  Scene scene;
  const std::int32_t grey = AddMaterial(scene, 0.5, 0), lamp = AddMaterial(scene, 0, 40);
  AddBox(scene, Vec3::Zero(), {5, 4, 3}, true, grey);
  AddBox(scene, {2.9, 1.9, 0.2}, {3.6, 2.4, 0.22}, false, grey);
  Add(scene, {{2.4, 1.9, 2.98}, {2.4, 2.1, 2.98}, {2.6, 2.1, 2.98}, {2.6, 1.9, 2.98}}, lamp);
  PipelineOptions options = Options(0.1);
  options.solver = "sampled";
  options.discontinuities = "none";
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  pipeline.BuildMesh(MeshKind::kInterpolant, {});
  const MeshLocator locator(scene, pipeline.mesh());
  constexpr PatchId kFloor = 0;
  ASSERT_EQ(scene.patches[kFloor].normal, Vec3::UnitZ());
  constexpr int kSide = 15;
  int far_off = 0, points = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      ReceiverPoint at;
      at.position = {3.0 + 0.5 * (i + 0.5) / kSide, 2.0 + 0.3 * (j + 0.5) / kSide, 0};
      at.normal = Vec3::UnitZ();
      const auto place = locator.Find(kFloor, at.position);
      ASSERT_TRUE(place);
      const double want = pipeline.irradiance().OnPatch(kFloor, at).irradiance.maxCoeff();
      far_off += std::abs(IrradianceAt(pipeline.mesh(), *place).maxCoeff() - want) > want ? 1 : 0;
      ++points;
    }
  std::printf("%d of %d points in the shadow err by more than their irradiance\n", far_off, points);
  EXPECT_LE(far_off, points / 20);
}

TEST(Refinement, KeepsSamplesAndSolution) {
  Solved solved(0.1);
  const RadiositySolution before = solved.pipeline.solution();
  std::atomic<std::size_t> calls = 0;
  const IrradianceSampler exact = solved.Sampler();
  const IrradianceSampler counting = [&](PatchId patch, const ReceiverPoint& at) {
    ++calls;
    return exact(patch, at);
  };
  MeshRefinementOptions options;
  options.error = 0.01;
  options.max_rounds = 0;
  const RefinedMesh coarse =
      RefineMesh({solved.pipeline.visibility(), before, exact}, {}, options, ExecutionContext());
  options.max_rounds = 3;
  const RefinedMesh fine =
      RefineMesh({solved.pipeline.visibility(), before, counting}, {}, options, ExecutionContext());
  EXPECT_LT(fine.share_above, coarse.share_above);
  EXPECT_GT(fine.mesh.triangles.size(), coarse.mesh.triangles.size());
  EXPECT_EQ(fine.report.counts.point_evaluations, calls);
  EXPECT_EQ(before.forest.size(), coarse.plan.forest.size());
  // From nothing, the final mesh alone takes this many: the rounds before it shared nearly all of theirs.
  SampleCache cache;
  const BuiltMesh once =
      BuildIrradianceMesh(solved.scene, fine.triangulations, InterpolantOrder::kQuadratic, exact, {}, &cache);
  EXPECT_LT(calls, 2 * once.point_evaluations);
  const BuiltMesh again =
      BuildIrradianceMesh(solved.scene, fine.triangulations, InterpolantOrder::kQuadratic, exact, {}, &cache);
  EXPECT_EQ(again.point_evaluations, 0U);
  EXPECT_EQ(std::memcmp(once.mesh.irradiance.data(), again.mesh.irradiance.data(),
                        once.mesh.irradiance.size() * sizeof(QuadraticInterpolant)),
            0);
  EXPECT_EQ(std::memcmp(once.mesh.irradiance.data(), fine.mesh.irradiance.data(),
                        once.mesh.irradiance.size() * sizeof(QuadraticInterpolant)),
            0);
}

// A refinement that is cancelled shows what its complete rounds have made: a whole mesh, better than the
// first.
TEST(Refinement, CancelledKeepsCompleteRounds) {
  Solved solved(0.1);
  const IrradianceSampler exact = solved.Sampler();
  const LightToShow light = {solved.pipeline.visibility(), solved.pipeline.solution(), exact};
  MeshRefinementOptions options;
  options.error = 0.01;
  options.max_rounds = 0;
  const RefinedMesh coarse = RefineMesh(light, {}, options, ExecutionContext());
  options.max_rounds = 4;
  const std::size_t all = RefineMesh(light, {}, options, ExecutionContext()).report.counts.point_evaluations;
  ExecutionContext context;
  std::atomic<std::size_t> calls = 0;
  const IrradianceSampler cancelling = [&](PatchId patch, const ReceiverPoint& at) {
    if (++calls == all - 1) context.Cancel();
    return exact(patch, at);
  };
  const RefinedMesh kept = RefineMesh({light.visibility, light.solution, cancelling}, {}, options, context);
  ASSERT_TRUE(context.Cancelled());
  EXPECT_GT(kept.mesh.triangles.size(), coarse.mesh.triangles.size());
  EXPECT_LT(kept.share_above, coarse.share_above);
  EXPECT_EQ(kept.errors.size(), kept.mesh.triangles.size());
  std::size_t triangles = 0;
  for (const PatchTriangulation& patch : kept.triangulations) {
    patch.Validate(solved.scene.patches[static_cast<std::size_t>(patch.patch)]);
    triangles += patch.triangles.size();
  }
  EXPECT_EQ(triangles, kept.mesh.triangles.size());
}

// The best for its cost comes first, what another has helped counts once, and enough is enough.
TEST(RefinementSteps, AreChosenByWhatTheyMendForTheirCost) {
  const auto step = [](double cost, std::vector<RefinementStep::Mended> mended) {
    RefinementStep s;
    s.cost = cost;
    s.mended = std::move(mended);
    return s;
  };
  const std::vector<RefinementStep> steps = {step(10, {{0, 1}, {1, 1}, {2, 1}}),  // 0.3
                                             step(2, {{0, 1}, {1, 1}}),           // 1
                                             step(1, {{3, 0.5}}),                 // 0.5
                                             step(10, {{4, 1}, {5, 1}})};         // 0.2
  EXPECT_EQ(ChooseRefinementSteps(steps, 100), (std::vector<std::size_t>{1, 2, 3}));
  EXPECT_EQ(ChooseRefinementSteps(steps, 2.5), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(ChooseRefinementSteps(steps, 2), (std::vector<std::size_t>{1}));
  EXPECT_TRUE(ChooseRefinementSteps(steps, 0).empty());
}

// A discontinuity is a step where its jump tells enough of the error of a triangle that it crosses; then
// dividing the leaf mends less than where the light is smooth. A leaf that the mesh has split is one step.
TEST(RefinementSteps, AreFoundWhereTheyHelp) {
  PatchTriangulation patch;
  patch.patch = 0;
  patch.in_plane = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  patch.triangles.resize(2);
  patch.triangles[0].vertex = {0, 1, 2};
  patch.triangles[1].vertex = {0, 2, 3};
  IrradianceMesh mesh;
  mesh.irradiance.assign(2, QuadraticInterpolant::Constant(Rgb::Constant(10)));
  mesh.triangles.resize(2);
  for (std::size_t t = 0; t < 2; ++t) {
    mesh.triangles[t].patch = 0;
    mesh.triangles[t].vertex = patch.triangles[t].vertex;
  }
  for (const Vec2& p : patch.in_plane) mesh.positions.push_back({p.x(), p.y(), 0});
  constexpr double kError = 0.02, kMeasured = 0.1;
  const std::vector<TriangleError> errors = {{kMeasured, kMeasured}, {0.001, 0.001}};
  // Upright through the first triangle, whose extent across it is 1: it tells of kKinkError x the gradient's
  // jump.
  const auto steps = [&](double told, const std::vector<ElementId>& leaves,
                         const std::vector<std::uint32_t>& first_triangle) {
    patch.leaves = leaves;
    patch.first_triangle = first_triangle;
    OmittedPart part;
    part.from = {0.8, 0.05};
    part.to = {0.8, 0.7};
    part.jump.kink.gradient = told * kMeasured * 10 / kKinkError;
    part.jump.kink.largest_value = 1e9;
    const std::vector<OmittedOfPatch> omitted = {{{}, {{3, 2, {part}}}}};
    return FindRefinementSteps(mesh, std::span(&patch, 1), errors, omitted, kError, 0);
  };
  constexpr ElementId kLeaf = 7;
  for (const bool split : {false, true}) {
    const std::vector<ElementId> leaves(split ? 2 : 1, kLeaf);
    const std::vector<std::uint32_t> first =
        split ? std::vector<std::uint32_t>{0, 1, 2} : std::vector<std::uint32_t>{0, 2};
    const std::vector<RefinementStep> smooth = steps(0.3, leaves, first);
    ASSERT_EQ(smooth.size(), 1U);
    EXPECT_EQ(smooth[0].leaf, kLeaf);
    ASSERT_EQ(smooth[0].mended.size(), 1U);
    EXPECT_DOUBLE_EQ(smooth[0].mended[0].area, 0.5);

    const std::vector<RefinementStep> told = steps(0.4, leaves, first);
    ASSERT_EQ(told.size(), 2U);
    EXPECT_FALSE(told[0].Divides());
    EXPECT_EQ(told[0].discontinuity, 3U);
    ASSERT_EQ(told[0].mended.size(), 1U);
    EXPECT_EQ(told[0].mended[0].triangle, 0U);
    EXPECT_DOUBLE_EQ(told[0].mended[0].area, 0.5);
    EXPECT_TRUE(told[1].Divides());
    EXPECT_DOUBLE_EQ(told[1].mended[0].area, 0.25);
    EXPECT_LT(told[0].cost, told[1].cost);
  }
}

// A mesh that begins with contacts alone asks for the edges of shadows where they tell of its errors; one
// that may not ask has to divide leaves along them, and takes more triangles and evaluations for the same
// error.
TEST(Refinement, AsksForEdgesThatAreMissing) {
  Solved solved(0.1);
  MeshOptions mesh;
  mesh.discontinuities.weight = DiscontinuityWeight::kIrradiance;
  mesh.discontinuities.min_weight = 1e9;
  mesh.discontinuities.max_leaf_dsets = 3;
  mesh.discontinuities.crowded_splits = 2;
  MeshRefinementOptions options;
  options.error = 0.01;
  const auto refine = [&](double min_wanted_weight, const MeshPlan* start) {
    mesh.discontinuities.min_wanted_weight = min_wanted_weight;
    return RefineMesh({solved.pipeline.visibility(), solved.pipeline.solution(), solved.Sampler()}, mesh,
                      options, ExecutionContext(), {nullptr, start, nullptr});
  };
  const RefinedMesh with = refine(1e-3, nullptr), without = refine(1e9, nullptr);
  std::size_t wanted = 0;
  for (const auto& patch : with.plan.wanted) wanted += patch.size();
  std::printf("%zu edges wanted: %zu triangles, %zu evaluations; without %zu, %zu\n", wanted,
              with.mesh.triangles.size(), with.report.counts.point_evaluations, without.mesh.triangles.size(),
              without.report.counts.point_evaluations);
  EXPECT_GE(wanted, 1U);
  EXPECT_LE(with.share_above, kShareAbove);
  EXPECT_LE(without.share_above, kShareAbove);
  EXPECT_LT(with.mesh.triangles.size(), without.mesh.triangles.size());
  EXPECT_LT(with.report.counts.point_evaluations, without.report.counts.point_evaluations);
  for (const PatchTriangulation& patch : with.triangulations)
    patch.Validate(solved.scene.patches[static_cast<std::size_t>(patch.patch)]);
  // Begun with what was asked for, nothing more is.
  EXPECT_EQ(refine(1e-3, &with.plan).mesh.triangles.size(), with.mesh.triangles.size());
}

// The same bytes for any number of threads.
TEST(Refinement, SameOnAnyNumberOfThreads) {
  const Scene scene = Room();
  std::vector<QuadraticInterpolant> first;
  for (const int threads : {1, 3}) {
    SetThreadCount(threads);
    Pipeline pipeline(scene, Options(0.1));
    pipeline.Solve({});
    pipeline.RefineLight({});
    pipeline.BuildMesh(MeshKind::kInterpolant, {});
    const std::vector<QuadraticInterpolant>& got = pipeline.mesh().irradiance;
    if (threads == 1) {
      first = got;
      continue;
    }
    ASSERT_EQ(first.size(), got.size());
    EXPECT_EQ(std::memcmp(first.data(), got.data(), got.size() * sizeof(QuadraticInterpolant)), 0);
  }
  SetThreadCount(0);
}

// A quadratic has no error anywhere on a triangle, another has the error of its cubic part: at the points of
// any number of samples.
TEST(TriangleErrors, AreThoseOfTheInterpolants) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  Add(scene, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0);
  const ElementForest forest(scene);
  const std::vector<PatchTriangulation> patches = {
      TriangulateLeaves(forest, 0, ActivateDiscontinuities(forest, 0, {}, {}))};
  for (const double cubic : {0.0, 1.0}) {
    const IrradianceSampler sampler = [&](PatchId, const ReceiverPoint& at) {
      const double x = at.position.x();
      return PointIrradianceResult{Rgb::Constant(10 + x * x + cubic * x * (x - 0.5) * (x - 1)), false};
    };
    const IrradianceMesh mesh =
        BuildIrradianceMesh(scene, patches, InterpolantOrder::kQuadratic, sampler, {}).mesh;
    for (const int samples : {1, 2, 5}) {
      std::atomic<std::size_t> calls = 0;
      const IrradianceSampler counting = [&](PatchId patch, const ReceiverPoint& at) {
        ++calls;
        return sampler(patch, at);
      };
      const std::vector<std::uint32_t> all = {0};
      const MeasuredTriangles measured =
          MeasureTriangles(scene, mesh, all, {samples, Rgb::Constant(10)}, counting);
      EXPECT_EQ(calls, static_cast<std::size_t>(samples * samples));
      EXPECT_EQ(measured.point_evaluations, calls);
      // The cubic vanishes at all nodes along x; its largest value in [0, 1] is sqrt(3) / 36.
      EXPECT_LE(measured.errors[0].max, cubic * std::sqrt(3.0) / 36 / 10 + 1e-13);
      if (cubic > 0) {
        EXPECT_GE(measured.errors[0].max, 0.5 * std::sqrt(3.0) / 36 / 10.2);
        EXPECT_LE(measured.errors[0].rms, measured.errors[0].max);
      }
    }
  }
}

// Half of a board is inside of a closed box. Nobody sees the dark half, where the mesh shows light: its error
// counts neither in the measurement nor in the refinement, and errors that can be seen count as before.
TEST(TriangleErrors, WhatNobodySeesDoesNotCount) {
  Scene scene;
  AddMaterial(scene, 0.5, 0);
  AddBox(scene, {-5, -5, -5}, {5, 5, 5}, true, 0);   // a room
  AddBox(scene, {-1, -1, -1}, {0, 1, 1}, false, 0);  // a box in the room
  const auto board = static_cast<PatchId>(scene.patches.size());
  Add(scene, {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}}, 0);
  const ElementForest forest(scene);
  std::vector<PatchTriangulation> patches;
  for (PatchId p = 0; p <= board; ++p)
    patches.push_back(TriangulateLeaves(forest, p, ActivateDiscontinuities(forest, p, {}, {})));
  const IrradianceMesh mesh = BuildIrradianceMesh(scene, patches, InterpolantOrder::kQuadratic,
                                                  [](PatchId, const ReceiverPoint&) {
                                                    return PointIrradianceResult{Rgb::Ones(), false};
                                                  },
                                                  {})
                                  .mesh;
  const auto light = [&](double outside) -> IrradianceSampler {
    return [outside, board](PatchId patch, const ReceiverPoint& at) {
      const bool inside = patch == board && at.position.x() < 0;
      return PointIrradianceResult{Rgb::Constant(inside ? 0 : outside), false};
    };
  };
  std::vector<std::uint32_t> all;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) all.push_back(t);
  const Enclosure enclosure(scene);
  const auto largest = [&](const TriangleSampling& sampling, double outside) {
    double error = 0;
    for (const TriangleError& of : MeasureTriangles(scene, mesh, all, sampling, light(outside)).errors)
      error = std::max(error, of.max);
    return error;
  };
  EXPECT_EQ(largest({4, Rgb::Ones(), &enclosure}, 1), 0);
  EXPECT_GT(largest({4, Rgb::Ones()}, 1), 10);
  EXPECT_NEAR(largest({4, Rgb::Ones(), &enclosure}, 2), 0.5, 1e-12);

  constexpr std::size_t kPoints = 4000;
  const IrradianceSampler exact = light(1);
  const MeasuredError error = MeasureError(scene, mesh, exact, {&exact, 1}, {kPoints, 1, 0.1});
  EXPECT_EQ(error.whole.max, 0);
  EXPECT_LT(error.whole.points, kPoints);
  EXPECT_GT(error.whole.points, kPoints - 10);  // the dark half is 1 / 1200 of the fronts
  for (const PartError& part : error.by_part) EXPECT_EQ(part.whole.max, 0) << part.name;
  const IrradianceSampler brighter = light(2);
  EXPECT_NEAR(MeasureError(scene, mesh, brighter, {}, {kPoints, 1, 0.1}).interpolant.p99, 0.5, 1e-12);
}

}  // namespace
}  // namespace penumbra::scene_test
