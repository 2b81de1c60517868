// What the probes show is what the solver computes: backprojected light adds up to the irradiance.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "display/viewer/error_map.h"
#include "display/viewer/irradiance_graph.h"
#include "display/viewer/links.h"
#include "display/viewer/mesh_tools.h"
#include "display/viewer/probes.h"
#include "solver/base/random.h"
#include "solver/transport/solvers/hierarchical_solver.h"
#include "tests/viewer/viewer_test_scenes.h"

namespace penumbra::viewer {
namespace {

struct Solved {
  Solved() : scene(viewer_test::ShadowScene()), pipeline(*scene, viewer_test::Options(false).solving) {
    pipeline.Solve(ExecutionContext());
    pipeline.RefineLight(ExecutionContext());
    pipeline.BuildMesh(MeshKind::kInterpolant, ExecutionContext());
    light = std::make_shared<const LightState>(scene,
                                               std::make_shared<const PatchVisibility>(pipeline.visibility()),
                                               pipeline.solution(), PointIrradianceOptions());
    mesh = std::make_shared<const MeshState>(scene, pipeline.mesh());
  }
  std::shared_ptr<const Scene> scene;
  Pipeline pipeline;
  std::shared_ptr<const LightState> light;
  std::shared_ptr<const MeshState> mesh;
};
const Solved& Shared() {
  static const Solved solved;
  return solved;
}

// Lambert's formula for the form factor of a point to a triangle above its horizon.
double FormFactor(const Vec3& at, const Vec3& normal, const std::array<Vec3, 3>& triangle) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 a = (triangle[k] - at).normalized(), b = (triangle[(k + 1) % 3] - at).normalized();
    const Vec3 cross = a.cross(b);
    if (cross.norm() > 0) sum += std::atan2(cross.norm(), a.dot(b)) * cross.normalized().dot(normal);
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

// The lamp is uniform, so that the irradiance from it is its radiosity times the form factor of what is seen.
TEST(Backprojection, VisiblePartsAddUpToTheIrradiance) {
  const Solved& s = Shared();
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const ProbedPoint at{0, Vec3(random.Uniform() * 1.9 - 0.95, random.Uniform() * 1.9 - 0.95, 0)};
    const ProbeResult probe = ProbeIrradiance(*s.light, s.mesh.get(), at);
    double from_lamp = 0;
    for (const PatchContribution& c : probe.sources)
      if (c.source == 1) from_lamp += c.irradiance[0];
    double seen = 0;
    for (const BackprojectedPatch& patch : Backproject(*s.light, at, ExecutionContext()))
      if (patch.source == 1)
        for (const auto& triangle : patch.visible) seen += FormFactor(at.position, Vec3::UnitZ(), triangle);
    worst = std::max(worst, std::abs(seen - from_lamp));
  }
  // Vertices are carried onto the lamp with some 1e-15, and small triangles lose digits in the sum.
  const double bound = 1e-11;
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LE(worst, bound);
}

TEST(Probe, AgreesWithThePipeline) {
  const Solved& s = Shared();
  const ProbedPoint at{0, Vec3(0.31, -0.27, 0)};
  const ProbeResult probe = ProbeIrradiance(*s.light, s.mesh.get(), at);
  ReceiverPoint receiver;
  receiver.position = at.position;
  const Rgb exact = s.pipeline.irradiance().OnPatch(0, receiver).irradiance;
  EXPECT_TRUE((probe.exact == exact).all());
  ASSERT_TRUE(probe.interpolated);
  EXPECT_TRUE((*probe.interpolated == *s.pipeline.Interpolated(0, at.position)).all());
  Rgb sum = Rgb::Zero();
  for (const PatchContribution& c : probe.sources) sum += c.irradiance;
  EXPECT_TRUE(((sum - exact).abs() <= 1e-12 * exact).all());
  EXPECT_EQ(probe.face, 0);
}

TEST(Graph, AgreesWithTheInterpolantsAtTheirNodes) {
  const Solved& s = Shared();
  const std::vector<std::uint32_t> triangles = {0, 1, 2};
  const IrradianceGraph graph =
      MakeGraph(*s.light, s.mesh->mesh(), triangles, {2, false, true}, ExecutionContext());
  ASSERT_EQ(graph.size(), 3U);
  for (const GraphSheet& sheet : graph) {
    ASSERT_EQ(sheet.exact.size(), 6U);
    // With two cells a side the grid's nodes are the interpolant's. There the two agree, up to the tolerance
    // of samples and of predicted midpoints, which are parts of the error.
    const double error = s.pipeline.options().error;
    std::size_t k = 0;
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2 - j; ++i, ++k) {
        const Rgb shown = s.mesh->mesh().irradiance[sheet.triangle].At(0.5 * i, 0.5 * j);
        EXPECT_TRUE(((shown - sheet.exact[k]).abs() <= 0.5 * error * sheet.exact[k]).all()) << shown << "\n"
                                                                                            << sheet.exact[k];
      }
  }
}

TEST(Graph, DynamicGridsFollowTheArea) {
  const Solved& s = Shared();
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < s.mesh->mesh().triangles.size(); ++i) all.push_back(i);
  for (const GraphSheet& sheet :
       MakeGraph(*s.light, s.mesh->mesh(), all, {40, true, false}, ExecutionContext())) {
    const ElementId leaf = LeafOf(*s.light, s.mesh->mesh(), sheet.triangle);
    const double share = TriangleArea(s.mesh->mesh(), sheet.triangle) / s.light->solution().forest[leaf].area;
    EXPECT_NEAR(sheet.cells, std::max(1.0, 40 * std::sqrt(share)), 0.51);
  }
}

TEST(ErrorMap, IsSmallWhereTheReportSaysSo) {
  const Solved& s = Shared();
  const ErrorMap map = MapRepresentationError(*s.light, s.mesh->mesh(), ExecutionContext());
  ASSERT_EQ(map.error.size(), s.mesh->mesh().triangles.size());
  // Every triangle's worst of four points against all points: of the same size, not smaller than half.
  const RepresentationError all = MeasureRepresentationError(
      *s.scene, s.mesh->mesh(),
      [&](PatchId patch, const ReceiverPoint& at) { return s.light->Exact().OnPatch(patch, at); }, 400, 2);
  EXPECT_GE(map.p99, 0.5 * all.p95);
  EXPECT_LE(map.p99, 20 * all.p99 + 1e-3);
}

TEST(Mesh, TrianglesOfElementsFillThem) {
  const Solved& s = Shared();
  const ElementForest& forest = s.light->solution().forest;
  for (ElementId e = 0; e < static_cast<ElementId>(forest.size()); ++e) {
    double area = 0;
    for (const std::uint32_t i : TrianglesOf(*s.light, s.mesh->mesh(), {&e, 1}))
      area += TriangleArea(s.mesh->mesh(), i);
    EXPECT_NEAR(area, forest[e].area, 1e-9 * forest[e].area);
  }
}

TEST(Links, FiltersKeepTheStrongest) {
  const RadiositySolution& solution = Shared().light->solution();
  OverlaySettings settings;
  EXPECT_TRUE(ShownLinks(solution, settings, {}).empty());
  settings.shown = {"visible-links", "split-links", "partial-links"};
  settings.link_limit = 1'000'000;
  const auto all = ShownLinks(solution, settings, {});
  EXPECT_EQ(all.size(), solution.links.links.size());
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_GE(LinkIrradiance(solution, solution.links.links[all[i - 1]]),
              LinkIrradiance(solution, solution.links.links[all[i]]));
  settings.link_limit = 3;
  const auto few = ShownLinks(solution, settings, {});
  ASSERT_EQ(few.size(), 3U);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.begin()));
  // The classes share the links out.
  settings.link_limit = 1'000'000;
  std::size_t sum = 0;
  for (const LinkClass link_class : {LinkClass::kVisible, LinkClass::kSplit, LinkClass::kPartial}) {
    settings.shown = {SwitchOf(link_class)};
    sum += ShownLinks(solution, settings, {}).size();
  }
  EXPECT_EQ(sum, all.size());
}

}  // namespace
}  // namespace penumbra::viewer
