// Leaves graded towards the ends of contact edges.

#include "mesh/discontinuities/contact_corners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "mesh/interpolants/irradiance_mesh_builder.h"
#include "mesh/interpolants/mesh_locator.h"
#include "mesh/interpolants/representation_error.h"
#include "mesh/pipeline/pipeline.h"
#include "mesh/refinement/local_pass.h"
#include "mesh_test_scenes.h"
#include "solver/base/random.h"
#include "tests/visibility/test_scenes.h"

namespace penumbra {
namespace {

using mesh_test::AddSquare;
using mesh_test::EmptyScene;

// The leaf that holds an end is divided as often as asked for, once for all ends that it holds; the quadtree
// is balanced, other leaves stay, and the least area holds.
TEST(ContactCorners, DividesTowardsTheEnds) {
  Scene scene = EmptyScene();
  AddSquare(scene, {0.5, 0.5, 0}, 0.5, true);
  const auto levels = [&](const std::vector<Vec2>& ends, int divisions, double min_area) {
    ElementForest forest(scene);
    forest.Subdivide(ElementForest::Root(0));
    DivideTowards(ends, divisions, min_area, 0, forest);
    EXPECT_EQ(forest.Balance(0), 0U);
    std::vector<int> found;
    for (const Vec2& end : ends) found.push_back(forest[forest.LeafAt(0, {end.x(), end.y(), 0})].level);
    for (const ElementId leaf : forest.Leaves(0)) EXPECT_GE(forest[leaf].area, min_area);
    return found;
  };
  EXPECT_EQ(levels({{0.1, 0.1}}, 4, 0), (std::vector<int>{5}));
  EXPECT_EQ(levels({{0.1, 0.1}, {0.4, 0.4}}, 4, 0), (std::vector<int>{5, 5}));
  EXPECT_EQ(levels({{0.1, 0.1}, {0.11, 0.1}}, 4, 0), (std::vector<int>{5, 5}));
  EXPECT_EQ(levels({{0.1, 0.1}}, 4, 1.0 / 64), (std::vector<int>{3}));
  EXPECT_EQ(levels({{0.1, 0.1}}, 0, 0), (std::vector<int>{1}));
  // On the border of leaves all of them are.
  ElementForest forest(scene);
  forest.Subdivide(ElementForest::Root(0));
  DivideTowards(std::vector<Vec2>{{0.5, 0.5}}, 1, 0, 0, forest);
  EXPECT_EQ(forest.Leaves(0).size(), 16U);
}

// A room with a lamp below its ceiling and a block of height 1 on its floor.
Scene RoomWithBlock(const Vec2& low, const Vec2& high) {
  Scene scene;
  const std::int32_t grey = scene_test::AddMaterial(scene, 0.5, 0),
                     lamp = scene_test::AddMaterial(scene, 0, 40);
  scene_test::AddBox(scene, Vec3::Zero(), {4, 3, 2.5}, true, grey);
  scene_test::AddBox(scene, {low.x(), low.y(), 0}, {high.x(), high.y(), 1}, false, grey);
  scene_test::Add(scene, {{2.5, 1, 2.25}, {2.5, 2, 2.25}, {3.5, 2, 2.25}, {3.5, 1, 2.25}}, lamp);
  return scene;
}

// Around the corners of a block on a floor the interpolants' error, root mean square over discs, falls with
// every division. The irradiance there depends on the direction alone, so what errs are the triangles at the
// corner: a quarter of the area for each division, half of the rms, once leaves are smaller than the discs.
// Bound: 3/4.
TEST(ContactCorners, GradingMendsWhatNoPolynomialFits) {
  const Vec2 low(1.13, 1.07), high(2.21, 1.93);
  const Scene scene = RoomWithBlock(low, high);
  PipelineOptions options;
  options.error = 0.1;
  options.refine = RefineBy::kTransport;
  options.error_points = 0;
  Pipeline pipeline(scene, options);
  pipeline.Solve({});
  const auto floor = static_cast<PatchId>(
      std::find_if(scene.patches.begin(), scene.patches.end(),
                   [](const Patch& p) { return p.normal.z() > 0.5 && p.vertex[0].z() == 0; }) -
      scene.patches.begin());
  const IrradianceSampler exact = [&](PatchId patch, const ReceiverPoint& at) {
    return pipeline.irradiance().OnPatch(patch, at);
  };
  std::vector<ReceiverPoint> at;
  std::vector<Rgb> truth;
  Random random(4);
  for (const Vec2& corner : {low, high, Vec2(low.x(), high.y()), Vec2(high.x(), low.y())})
    for (int i = 0; i < 100; ++i) {
      const double r = 0.05 * std::sqrt(random.Uniform()), angle = 2 * std::numbers::pi * random.Uniform();
      const Vec2 p = corner + r * Vec2(std::cos(angle), std::sin(angle));
      if ((p.array() > low.array()).all() && (p.array() < high.array()).all()) continue;  // under the block
      ReceiverPoint point;
      point.position = {p.x(), p.y(), 0};
      point.normal = Vec3::UnitZ();
      at.push_back(point);
      truth.push_back(exact(floor, point).irradiance);
    }
  double first = 0, last = 0;
  constexpr int kFirst = 3, kLast = 6;  // leaves of 6 cm, and smaller, beside discs of 5
  for (const int divisions : {0, kFirst, kFirst + 1, kFirst + 2, kLast}) {
    DiscontinuityOptions discontinuities = pipeline.resolved().discontinuities;
    discontinuities.corner_divisions = divisions;
    MeshReport report;
    const MeshPlan plan = BeginPlan(pipeline.visibility(), pipeline.solution(), discontinuities);
    const std::vector<PatchTriangulation> patches =
        PatchTriangulator(pipeline.visibility(), pipeline.solution(), discontinuities, {})
            .Triangulate(plan, report);
    for (const PatchTriangulation& patch : patches)
      patch.Validate(scene.patches[static_cast<std::size_t>(patch.patch)]);
    const IrradianceMesh mesh =
        BuildIrradianceMesh(scene, patches, InterpolantOrder::kQuadratic, exact, {}).mesh;
    const MeshLocator locator(scene, mesh);
    std::vector<Rgb> shown;
    for (const ReceiverPoint& point : at)
      shown.push_back(IrradianceAt(mesh, *locator.Find(floor, point.position)).max(0.0));
    double squares = 0;
    const std::vector<double> errors = RelativeErrors(shown, truth);
    for (const double e : errors) squares += e * e;
    last = std::sqrt(squares / static_cast<double>(errors.size()));
    if (divisions == kFirst) first = last;
    std::printf("%d divisions: rms %.3g, %zu triangles\n", divisions, last, mesh.triangles.size());
  }
  EXPECT_LE(last, std::pow(0.75, kLast - kFirst) * first);
}

}  // namespace
}  // namespace penumbra
