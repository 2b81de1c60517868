// The dense solver past blockers, on skew shapes, and against manufactured solutions.

#include "solver/transport/solvers/dense_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "solver/base/parallel.h"
#include "solver/base/random.h"
#include "solver/transport/sources/source_quadrature.h"
#include "tests/transport/manufactured.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra {
namespace {

// A room with two tilted panels in it, one of them a triangle.
Scene RoomWithPanels() {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 1);
  scene_test::AddMaterial(scene, 0.75, 0.25);
  scene_test::AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, 0);
  const auto panel = [&](const Polygon3& polygon) {
    scene_test::Add(scene, polygon, 1);
    scene_test::Add(scene, {polygon.rbegin(), polygon.rend()}, 1);
  };
  panel({{0.4, 0.5, 0.7}, {1.5, 0.6, 0.75}, {1.6, 1.4, 1.3}, {0.5, 1.3, 1.25}});
  panel({{0.3, 2.1, 0.2}, {1.4, 2.5, 0.3}, {0.8, 2.4, 1.7}});
  return scene;
}

// The nodes on what a point sees of a source add up to its form factor, past blockers and in part below the
// horizon, near and far: two ways to one number.
TEST(SourceQuadrature, AddsUpToTheFormFactor) {
  const Scene scene = RoomWithPanels();
  const PatchVisibility visibility(scene);
  Random random(11);
  double worst = 0, worst_sum = 0;  // of what is allowed; absolute
  std::size_t blocked = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto own = static_cast<PatchId>(random.Index(static_cast<std::uint32_t>(scene.patches.size())));
    const Patch& patch = scene.patches[own];
    // Down to 1e-6 of the patch from its border.
    const double near = random.LogUniform(1e-6, 1);
    const double s = near * random.Uniform(), t = random.Uniform() * (1 - s);
    ReceiverPoint at;
    at.position = patch.vertex[0] + s * (patch.vertex[1] - patch.vertex[0]) +
                  t * (patch.vertex[2] - patch.vertex[1]) * (patch.size == 3 ? s : 1);
    at.normal = patch.normal;
    PointView view(scene, at);
    for (const PatchPair& pair : visibility.SourcesOf(own)) {
      if (!view.FaceSource(pair.source)) continue;
      std::vector<SourceNode> nodes;
      const auto part = scene.patches[pair.source].Vertices();
      AddVisibleSourceNodes(view, part, visibility.Blockers(pair), own, nodes);
      double sum = 0;
      for (const SourceNode& node : nodes) sum += node.weight;
      double want = 0;
      const DirectionPolygon seen = view.SeeSource(part);
      std::vector<Occluder> occluders;
      if (!seen.empty() && view.FindBlockers(visibility.Blockers(pair), own, seen, occluders))
        want = view.VisibleFormFactor(seen, occluders);
      blocked += occluders.empty() ? 0 : 1;
      const double error = std::abs(sum - want);
      worst_sum = std::max(worst_sum, error);
      worst = std::max(worst, error / SourceQuadratureError(at, scene.patches[pair.source]));
    }
  }
  std::printf("worst difference %.2g, %.2g of what is allowed, %zu times past blockers\n", worst_sum, worst,
              blocked);
  EXPECT_LE(worst, 1);
  EXPECT_GT(blocked, 100U);
}

// Functions of a basis are 1 at their own node and 0 at the others; together they make every polynomial of
// their degree, 1 among them.
TEST(ElementBasis, HasAllPolynomials) {
  const Polygon3 triangle = {{1, 2, 3}, {2, 2.5, 3}, {1.25, 4, 3.5}},
                 square = {{1, 2, 3}, {2, 2.5, 3}, {2.25, 4.5, 3.5}, {1.25, 4, 3.5}};
  for (const Polygon3& polygon : {triangle, square})
    for (const BasisDegree degree : {BasisDegree::kConstant, BasisDegree::kLinear, BasisDegree::kQuadratic}) {
      const ElementBasis basis(polygon, degree);
      const auto field = [&](const Vec3& p) {
        const double x = p.x() - 2 * p.y() + 0.5 * p.z();
        return degree == BasisDegree::kConstant ? 3 : degree == BasisDegree::kLinear ? 3 + x : 3 + x - x * x;
      };
      double mean = 0;
      for (std::size_t i = 0; i < basis.size(); ++i) mean += basis.Weight(i);
      EXPECT_NEAR(mean, 1, 1e-15);
      for (const Vec3& p : polygon) {
        const ElementBasis::Values at = basis.At(p);
        double got = 0;
        for (std::size_t i = 0; i < basis.size(); ++i) got += at[i] * field(basis.Node(i));
        EXPECT_NEAR(got, field(p), 1e-12 * 50);
      }
    }
}

// A field that is quadratic over each patch is found again by quadratic elements, one a patch, past panels
// that hide parts of it, and a linear one by linear elements; a cubic one is not.
TEST(DenseSolver, FindsManufacturedPolynomials) {
  const Scene scene = RoomWithPanels();
  const PatchVisibility visibility(scene);
  for (const BasisDegree degree : {BasisDegree::kLinear, BasisDegree::kQuadratic}) {
    for (const bool beyond : {false, true}) {
      const int power = static_cast<int>(degree) + (beyond ? 1 : 0);
      const RadiosityField field = [&](PatchId patch, const Vec3& p) {
        const double x = p.x() + 0.5 * p.y() - 0.25 * p.z() + 0.125 * patch;
        return Rgb(3 + x, 2 + std::pow(x, power), 5 - std::pow(x, power));
      };
      DenseOptions options;
      options.degree = degree;
      const DenseSystem system = AssembleDense(UniformForest(scene, 1), visibility, options, {});
      std::vector<Rgb> emittance(system.size(), Rgb::Zero()), reflectance;
      ParallelFor(system.size(), 1, [&](std::size_t i) {
        const DenseElement& element = system.elements[system.element_of_unknown[i]];
        emittance[i] = ManufacturedEmittance(scene, visibility, field, system.PatchOf(i),
                                             element.basis.Node(i - element.first));
      });
      for (std::size_t i = 0; i < system.size(); ++i)
        reflectance.push_back(scene.MaterialOf(system.PatchOf(i)).reflectance);
      const DenseLight light = SolveDense(system, emittance, reflectance);
      double worst = 0;
      for (std::size_t i = 0; i < system.size(); ++i) {
        const DenseElement& element = system.elements[system.element_of_unknown[i]];
        const Rgb want = field(system.PatchOf(i), element.basis.Node(i - element.first));
        worst = std::max(worst, ((light.radiosity[i] - want) / want).abs().maxCoeff());
      }
      std::printf("degree %d, field of degree %d: worst relative error %.2g\n", static_cast<int>(degree),
                  power, worst);
      // Some bounces add up errors of the quadrature.
      if (beyond)
        EXPECT_GE(worst, 1e-6);
      else
        EXPECT_LE(worst, 20 * kSourceQuadratureError);
    }
  }
}

// Tiles that emit what a smooth field asks for bring the irradiance to the field's as they shrink: with order
// 2, away from edges, where no source is nearer than the size of its tile. The hierarchical solver comes as
// near.
TEST(DenseSolver, ManufacturedTilesConverge) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, 0);
  const PatchVisibility visibility(scene);
  const RadiosityField field = [](PatchId, const Vec3& p) {
    return Rgb::Constant(4 + std::sin(p.x() + 0.5 * p.y()) * std::cos(p.z()));
  };
  std::map<std::string, std::vector<double>> errors;
  for (const int divisions : {2, 4}) {
    const Scene tiled = ManufacturedScene(scene, visibility, field, divisions);
    const PatchVisibility tiles_see(tiled);
    std::map<std::string, RadiositySolution> solutions;
    const DenseSystem system = AssembleDense(UniformForest(tiled, 1), tiles_see, {}, {});
    solutions.emplace("dense", ToRadiositySolution(system, SolveDense(system)));
    // Dear with many patches: once is enough to tell.
    if (divisions == 2) solutions.emplace("hierarchical", scene_test::Solved(tiled, 0.1, 1e-3));
    for (const auto& [name, solution] : solutions) {
      const PointIrradiance irradiance(tiled, tiles_see, SourceSet::FromSolution(solution));
      double square = 0, count = 0;
      for (PatchId wall = 0; wall < 6; ++wall)
        for (const Vec2& at : {Vec2(0.31, 0.43), Vec2(0.62, 0.37), Vec2(0.55, 0.69), Vec2(0.4, 0.5)}) {
          const Patch& patch = scene.patches[wall];
          const ReceiverPoint point =
              scene_test::Receiver(patch.vertex[0] + at.x() * (patch.vertex[1] - patch.vertex[0]) +
                                       at.y() * (patch.vertex[3] - patch.vertex[0]),
                                   patch.normal);
          const double want = FieldIrradiance(scene, visibility, field, wall, point)[0],
                       got = irradiance.Anywhere(point).irradiance[0];
          square += (got / want - 1) * (got / want - 1);
          ++count;
        }
      errors[name].push_back(std::sqrt(square / count));
    }
  }
  const std::vector<double>& dense = errors["dense"];
  const double order = std::log2(dense[0] / dense[1]), hierarchical = errors["hierarchical"][0];
  std::printf("dense: rms %.3g, %.3g, order %.2f; hierarchical: %.3g\n", dense[0], dense[1], order,
              hierarchical);
  EXPECT_GE(order, 1.5);
  EXPECT_LE(dense[1], 2e-3);
  // Constant tiles err more than the links do.
  EXPECT_LE(hierarchical, 1.25 * dense[0]);
}

// Exact probes of the constant solution give back the mean irradiance of every element, to what their rule
// over it misses.
TEST(DenseSolver, ProbesAgreeWithElements) {
  const Scene scene = RoomWithPanels();
  const PatchVisibility visibility(scene);
  const DenseSystem system = AssembleDense(UniformForest(scene, 2), visibility, {.tolerance = 1e-5}, {});
  const DenseClosure closure = MeasureClosure(system);
  EXPECT_NEAR(closure.least_row_sum, 1, system.form_factor_error + 1e-12);
  EXPECT_NEAR(closure.largest_row_sum, 1, system.form_factor_error + 1e-12);
  EXPECT_LE(closure.reciprocity, 1e-14);
  const RadiositySolution solution = ToRadiositySolution(system, SolveDense(system));
  const PointIrradiance irradiance(solution, visibility);
  double square = 0, count = 0;
  for (const DenseElement& element : system.elements) {
    const Rgb mean = ExactLeafIrradiance(solution, irradiance, element.leaf, LeafSampling::kCubature).mean;
    const double off = mean[0] / solution.irradiance[element.leaf][0] - 1;
    square += off * off;
    ++count;
  }
  std::printf("rows within %.2g, stated %.2g; probes off by rms %.2g\n",
              std::max(1 - closure.least_row_sum, closure.largest_row_sum - 1), system.form_factor_error,
              std::sqrt(square / count));
  EXPECT_LE(std::sqrt(square / count), 2e-3);
}

// The same bits on any number of threads.
TEST(DenseSolver, DoesNotDependOnThreads) {
  const Scene scene = RoomWithPanels();
  const PatchVisibility visibility(scene);
  for (const BasisDegree degree : {BasisDegree::kConstant, BasisDegree::kLinear}) {
    DenseOptions options;
    options.degree = degree;
    options.tolerance = 1e-3;
    std::vector<DenseSystem> systems;
    for (const int threads : {1, 3}) {
      SetThreadCount(threads);
      systems.push_back(AssembleDense(UniformForest(scene, 1), visibility, options, {}));
    }
    SetThreadCount(0);
    EXPECT_TRUE(systems[0].transport == systems[1].transport);
  }
}

}  // namespace
}  // namespace penumbra
