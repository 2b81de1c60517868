// Light reconstructed from the vertices of quadtrees: polynomials that are reproduced, and continuity across
// edges with T-vertices.

#include "mesh/interpolants/hermite_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "mesh/interpolants/vertex_light.h"
#include "solver/base/random.h"
#include "solver/transport/links/element_forest.h"
#include "solver/transport/links/element_locator.h"
#include "tests/mesh/mesh_test_scenes.h"

namespace penumbra {
namespace {

using Function = std::function<double(double u, double v)>;

Scene OneSquare() {
  Scene scene = mesh_test::EmptyScene();
  mesh_test::AddSquare(scene, {0, 0, 0}, 1, true);
  return scene;
}

// Divides leaves at random places, so that neighbours differ by several levels.
ElementForest UnbalancedForest(const Scene& scene, int divisions, std::uint64_t seed) {
  ElementForest forest(scene);
  if (divisions > 0) forest.Subdivide(ElementForest::Root(0));
  Random random(seed);
  for (int i = 1; i < divisions; ++i) {
    const std::vector<ElementId> leaves = forest.Leaves(0);
    ElementId chosen =
        leaves[static_cast<std::size_t>(random.Uniform() * static_cast<double>(leaves.size()))];
    if (i % 2 == 0) chosen = forest.Leaves(0).front();  // deep in one corner
    if (forest[chosen].level < 9) forest.Subdivide(chosen);
  }
  return forest;
}

VertexLight VerticesLitBy(const ElementForest& forest, const Function& f) {
  VertexLight light;
  for (const ElementId leaf : forest.Leaves(0))
    for (const LatticePoint& p : forest[leaf].Corners())
      light[p] =
          Rgb(1, 2, 3) * f(static_cast<double>(p.x) / kLatticeSize, static_cast<double>(p.y) / kLatticeSize);
  return light;
}

// The largest deviation of the light from f, in the first channel, at a grid that hits no vertex.
double LargestDeviation(const ElementForest& forest, const Function& f) {
  const HermiteSurface surface(forest, 0, VerticesLitBy(forest, f));
  double largest = 0;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) {
      const double u = (i + 0.37) / 40, v = (j + 0.61) / 40;
      const Rgb value = surface.At(u, v).value;
      EXPECT_NEAR(value[2], 3 * value[0], 1e-12);
      largest = std::max(largest, std::abs(value[0] - f(u, v)));
    }
  return largest;
}

constexpr double kHermiteRounding =
    1e-12;  // of some hundred sums of values of about 1, divided by small steps

TEST(HermiteSurface, ReproducesBilinearLightOnEveryTree) {
  const Scene scene = OneSquare();
  const Function bilinear = [](double u, double v) { return 1 + 2 * u - 3 * v + 4 * u * v; };
  for (const int divisions : {0, 1, 2, 40})
    EXPECT_LE(LargestDeviation(UnbalancedForest(scene, divisions, 5), bilinear), kHermiteRounding)
        << divisions;
}

TEST(HermiteSurface, ReproducesQuadraticLightOnUnrestrictedTrees) {
  const Scene scene = OneSquare();
  const Function quadratic = [](double u, double v) {
    return 1 + 2 * u - 3 * v + 4 * u * v - 5 * u * u + 6 * v * v;
  };
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const ElementForest forest = UnbalancedForest(scene, 40, seed);
    EXPECT_LE(LargestDeviation(forest, quadratic), 100 * kHermiteRounding) << seed;
  }
  EXPECT_GT(LargestDeviation(ElementForest(scene), quadratic), 0.1) << "four values do not tell a curvature";
}

// With exact derivatives, the error of cubic Hermite pieces is of the fourth order. Inside, those of
// parabolas are off by the second order, so that the error is of the third.
TEST(HermiteSurface, ConvergesWithTheThirdOrder) {
  const Scene scene = OneSquare();
  const Function wave = [](double u, double v) { return std::sin(3 * u) * std::cos(2 * v); };
  std::vector<double> errors;
  ElementForest forest(scene);
  for (int level = 0; level < 5; ++level) {
    for (const ElementId leaf : forest.Leaves(0)) forest.Subdivide(leaf);
    errors.push_back(LargestDeviation(forest, wave));
  }
  for (std::size_t i = 2; i < errors.size(); ++i) EXPECT_LE(errors[i], errors[i - 1] / 6) << i;
}

// Value and derivatives are the same from both sides of every edge, at T-vertices and between them; and the
// light passes through all samples.
TEST(HermiteSurface, IsSmoothAcrossEdgesWithTVertices) {
  const Scene scene = OneSquare();
  const ElementForest forest = UnbalancedForest(scene, 60, 11);
  Random random(3);
  VertexLight light = VerticesLitBy(forest, [](double, double) { return 0; });
  for (const ElementId leaf : forest.Leaves(0))
    for (const LatticePoint& p : forest[leaf].Corners()) light[p] = Rgb::Constant(random.Uniform());
  const HermiteSurface surface(forest, 0, light);
  for (const auto& [p, value] : light) {
    const double u = static_cast<double>(p.x) / kLatticeSize, v = static_cast<double>(p.y) / kLatticeSize;
    EXPECT_NEAR(surface.At(u, v).value[0], value[0], kHermiteRounding);
  }
  constexpr double kStep = 1e-9;
  // Second derivatives are about 1 / (side of the smallest element)^2 = 4^9.
  const double tolerance = 100 * std::pow(4.0, 9) * kStep;
  std::size_t edges = 0;
  for (const ElementId id : forest.Leaves(0)) {
    const Element& leaf = forest[id];
    const double u = static_cast<double>(leaf.corner[1].x) / kLatticeSize,
                 low = static_cast<double>(leaf.corner[1].y) / kLatticeSize,
                 high = static_cast<double>(leaf.corner[2].y) / kLatticeSize;
    if (u == 1) continue;
    ++edges;
    for (const double part : {0.0, 0.3, 0.5, 0.8, 1.0}) {
      const double v = low + part * (high - low);
      for (const bool swapped : {false, true}) {  // edges along v, and the tree's cells along u
        const auto at = [&](double x) { return swapped ? surface.At(v, x) : surface.At(x, v); };
        const HermiteSurface::Jet before = at(u - kStep), after = at(u + kStep);
        EXPECT_NEAR(before.value[0], after.value[0], tolerance);
        EXPECT_NEAR(before.by_u[0], after.by_u[0], tolerance);
        EXPECT_NEAR(before.by_v[0], after.by_v[0], tolerance);
      }
    }
  }
  EXPECT_GT(edges, 50U);
}

TEST(HermiteSurface, DerivativesAreThoseOfTheValues) {
  const Scene scene = OneSquare();
  const ElementForest forest = UnbalancedForest(scene, 30, 4);
  const HermiteSurface surface(
      forest, 0, VerticesLitBy(forest, [](double u, double v) { return std::sin(5 * u * v + v); }));
  constexpr double kStep = 1e-5;
  for (const auto& [u, v] : {std::pair(0.213, 0.377), std::pair(0.61, 0.93), std::pair(0.02, 0.05)}) {
    const auto slope = [&](double du, double dv) {
      return (surface.At(u + du, v + dv).value[0] - surface.At(u - du, v - dv).value[0]) / (2 * kStep);
    };
    const HermiteSurface::Jet jet = surface.At(u, v);
    EXPECT_NEAR(jet.by_u[0], slope(kStep, 0), 1e-4);
    EXPECT_NEAR(jet.by_v[0], slope(0, kStep), 1e-4);
    EXPECT_NEAR(jet.by_uv[0],
                (surface.At(u, v + kStep).by_u[0] - surface.At(u, v - kStep).by_u[0]) / (2 * kStep), 1e-3);
  }
}

// Averages at the vertices: of four leaves in the middle, of two at a T-vertex; between the corners bilinear.
TEST(VertexLight, AveragesTheLeavesThatShareAVertex) {
  const Scene scene = OneSquare();
  ElementForest forest(scene);
  const ElementId first = forest.Subdivide(ElementForest::Root(0));
  const ElementId fine = forest.Subdivide(first);
  std::vector<Rgb> irradiance;
  for (std::size_t i = 0; i < forest.size(); ++i)
    irradiance.push_back(Rgb::Constant(static_cast<double>(i * i)));
  const auto of = [&](ElementId id) { return irradiance[static_cast<std::size_t>(id)][0]; };
  const VertexLight light = NodalAverages(forest, irradiance).at(0);
  constexpr std::int32_t kHalf = kLatticeSize / 2, kQuarter = kLatticeSize / 4;
  EXPECT_EQ(light.at({0, 0})[0], of(fine));
  EXPECT_NEAR(light.at({kHalf, kHalf})[0], (of(fine + 2) + of(first + 1) + of(first + 2) + of(first + 3)) / 4,
              1e-12);
  EXPECT_NEAR(light.at({kHalf, kQuarter})[0], (of(fine + 1) + of(fine + 2)) / 2, 1e-12)
      << "the coarse leaf has no corner at a T-vertex";
  const ElementLocator locator(forest);
  const ElementLocator::Place place = locator.Find(0, {0.75, 0.5, 0});
  EXPECT_EQ(place.element, first + 2);
  const Element& leaf = forest[place.element];
  const auto corner = [&](std::size_t k) { return light.at(leaf.corner[k])[0]; };
  EXPECT_NEAR(BilinearAt(leaf, light, place.s, place.t)[0],
              (corner(0) + corner(3)) / 8 + 3 * (corner(1) + corner(2)) / 8, 1e-12);
}

}  // namespace
}  // namespace penumbra
