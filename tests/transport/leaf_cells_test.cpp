// Leaves cut into parts by what their light costs where it arrives: they tile their leaves, keep constants,
// and bring irradiance as near to the continuous radiosity equation as is asked for, beside edges too.

#include "solver/transport/points/leaf_cells.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/parallel.h"
#include "tests/transport/transport_test_tools.h"
#include "tests/transport/truth_files.h"

namespace penumbra {
namespace {

SolverOptions Asked(double source_error) {
  SolverOptions options;
  options.eps = 0.4 * std::sqrt(source_error);
  options.min_area = 1e-7;
  options.relative_cutoff = 0.01 * source_error;
  options.source_error = source_error;
  return options;
}

// Every case of radiosity_continuous.json, with points down to 2^-10 from the edges, where radiosity goes as
// d^0.763: the largest relative error is about what was asked for (bounces of reflectance 3/4 double it), and
// falls with it.
TEST(LeafCells, ContinuousRadiosity) {
  const truth::json cases = truth::Load("radiosity_continuous.json");
  for (const truth::json& c : cases["cases"]) {
    const Scene scene = truth::UnitScene(c);
    const PatchVisibility visibility(scene);
    double before = 1;
    for (const double asked : {0.02, 0.005}) {
      HierarchicalSolver solver(scene, visibility, Asked(asked));
      solver.Solve({});
      const PointIrradiance exact(solver.solution(), visibility);
      double worst = 0;
      for (const auto& [surface, points] : c["irradiance"].items())
        for (const truth::json& p : points) {
          const auto [patch, at] = truth::UnitPoint(c, surface, p["a"].get<double>(), p["b"].get<double>());
          const double want = truth::ToDouble(p["H"]);
          const double got =
              exact.OnPatch(patch, scene_test::Receiver(at, scene.patches[patch].normal)).irradiance[0];
          worst = std::max(worst, std::abs(got / want - 1));
        }
      std::printf("%s, asked for %g: worst relative error %.2g, %zu links, %zu sources\n",
                  c["id"].get<std::string>().c_str(), asked, worst, solver.solution().links.links.size(),
                  exact.sources().LeafRadiosities().size());
      EXPECT_LE(worst, 2.5 * asked) << c["id"];
      EXPECT_LE(worst, 0.5 * before) << c["id"];
      before = worst;
    }
  }
}

// A room with a box on its floor: the pieces of each leaf tile it, its irradiance is their mean, and the
// bytes are the same for one thread and for three.
TEST(LeafCells, TileTheirLeaves) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0);
  scene_test::AddMaterial(scene, 0.2, 1);
  scene_test::AddBox(scene, Vec3::Zero(), {1, 1, 1}, true, {0, 1, 0, 0, 0, 0});
  scene_test::AddBox(scene, {0.3, 0.35, 0}, {0.6, 0.6, 0.3}, false, 0);
  const PatchVisibility visibility(scene);
  std::vector<Rgb> first;
  for (const int threads : {1, 3}) {
    SetThreadCount(threads);
    HierarchicalSolver solver(scene, visibility, Asked(0.02));
    solver.Solve({});
    const RadiositySolution& solution = solver.solution();
    double worst_area = 0, worst_mean = 0;
    std::size_t cut = 0;
    std::vector<Rgb> light;
    for (const Fragment& fragment : solution.fragments) light.push_back(fragment.irradiance);
    for (const ElementId leaf : solution.forest.AllLeaves()) {
      const std::span<const Fragment> pieces = solution.FragmentsOf(leaf);
      if (pieces.empty()) continue;
      ++cut;
      double area = 0;
      Rgb sum = Rgb::Zero();
      bool dark = false;  // what a box covers stays dark whatever its leaf receives
      for (const Fragment& piece : pieces) {
        area += piece.area;
        sum += piece.area * piece.irradiance;
        dark = dark || (piece.irradiance == 0).any();
      }
      const Rgb& want = solution.irradiance[static_cast<std::size_t>(leaf)];
      worst_area = std::max(worst_area, std::abs(area / solution.forest[leaf].area - 1));
      if (!dark) worst_mean = std::max(worst_mean, (sum / area - want).abs().maxCoeff() / want.maxCoeff());
    }
    std::printf("%zu of %zu leaves in %zu pieces; areas off by %.2g, means by %.2g\n", cut,
                solution.forest.AllLeaves().size(), solution.fragments.size(), worst_area, worst_mean);
    EXPECT_GT(cut, 10U);
    EXPECT_LE(worst_area, 1e-7);  // cuts snap to vertices within 1e-9 of their part
    EXPECT_LE(worst_mean, 1e-9);
    if (threads == 1) {
      first = light;
    } else {
      ASSERT_EQ(first.size(), light.size());
      for (std::size_t i = 0; i < light.size(); ++i) EXPECT_TRUE((first[i] == light[i]).all());
    }
  }
  SetThreadCount(0);
}

// In a closed room where emittance is what reflectance lacks radiosity is 1: nothing is cut, and nothing is
// off.
TEST(LeafCells, ConstantsStayWhole) {
  Scene scene;
  scene_test::AddMaterial(scene, 0.5, 0.5);
  scene_test::AddBox(scene, Vec3::Zero(), {1, 2, 1}, true, 0);
  const PatchVisibility visibility(scene);
  SolverOptions options = Asked(1e-4);
  options.eps = 0.2;
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve({});
  double worst = 0;
  for (const Rgb& radiosity : solver.solution().radiosity)
    worst = std::max(worst, (radiosity - 1).abs().maxCoeff());
  std::printf("%zu pieces, radiosity off by %.2g\n", solver.solution().fragments.size(), worst);
  EXPECT_LE(worst, 1e-4);
}

}  // namespace
}  // namespace penumbra
