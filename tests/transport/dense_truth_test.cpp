// The dense solver against reference values with 12 to 24 digits.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "solver/transport/solvers/dense_solver.h"
#include "tests/transport/transport_test_tools.h"
#include "tests/transport/truth_files.h"

namespace penumbra {
namespace {

using namespace truth;

// The unit cube of every case of radiosity_constant_basis.json, up to 384 elements, to the tolerance that it
// states: means of faces, and element by element where they are given.
TEST(DenseTruth, ConstantElements) {
  const json truth = Load("radiosity_constant_basis.json");
  double worst = 0;
  std::map<int, DenseSystem> systems;  // per n: the matrix knows no reflectances
  for (const json& c : truth["cases"]) {
    const Scene scene = UnitScene(c);
    const PatchVisibility visibility(scene);
    const int n = c["n"].get<int>();
    if (!systems.contains(n)) systems[n] = AssembleDense(UniformForest(scene, n), visibility, {}, {});
    const DenseSystem& system = systems[n];
    std::vector<Rgb> emittance, reflectance;
    for (std::size_t i = 0; i < system.size(); ++i) {
      emittance.push_back(scene.MaterialOf(system.PatchOf(i)).emittance);
      reflectance.push_back(scene.MaterialOf(system.PatchOf(i)).reflectance);
    }
    const DenseLight light = SolveDense(system, emittance, reflectance);
    const double rtol = c["rtol"].get<double>();
    const auto expect = [&](double got, double want, const std::string& what) {
      EXPECT_NEAR(got, want, rtol * want) << c["id"] << " " << what;
      worst = std::max(worst, std::abs(got - want) / (rtol * want));
    };
    const std::map<std::string, PatchId> patches = {{"floor", 0}, {"ceiling", 1}, {"wall", 4}};
    for (const auto& [name, patch] : patches) {
      const std::size_t first = system.first_of_patch[patch], last = system.first_of_patch[patch + 1];
      double mean = 0;
      for (std::size_t e = first; e < last; ++e) mean += system.elements[e].area * light.radiosity[e][0];
      if (c.contains("mean_B")) expect(mean, ToDouble(c["mean_B"][name]), name);
      if (!c.contains("B")) continue;
      const json& want = c["B"][name];
      if (want.is_string()) {
        expect(mean, ToDouble(want), name);
        continue;
      }
      for (std::size_t e = first; e < last; ++e) {
        const Vec3 p = n * Centroid(system.elements[e].polygon);
        const auto i = static_cast<std::size_t>(patch == 4 ? p.y() : p.x()),
                   j = static_cast<std::size_t>(patch == 4 ? p.z() : p.y());
        expect(light.radiosity[e][0], ToDouble(want[i][j]), name);
      }
    }
  }
  for (const auto& [n, system] : systems) {
    const DenseClosure closure = MeasureClosure(system);
    std::printf("n = %d: rows add up to 1 - %.2g ... 1 + %.2g, form factors off by at most %.2g\n", n,
                1 - closure.least_row_sum, closure.largest_row_sum - 1, system.form_factor_error);
    EXPECT_NEAR(closure.least_row_sum, 1, 1e-12);
    EXPECT_NEAR(closure.largest_row_sum, 1, 1e-12);
  }
  std::printf("%zu cases, worst error / tolerance %.3g\n", truth["cases"].size(), worst);
}

// The closed rooms of radiosity_exact.json, the L-shaped one and the one with a box inside too: every element
// of every degree has radiosity 1, to 1e-9.
TEST(DenseTruth, Furnaces) {
  const json truth = Load("radiosity_exact.json");
  int tested = 0;
  for (const json& c : truth["cases"]) {
    if (!c.contains("faces")) continue;
    ++tested;
    const Scene scene = FacesOf(c);
    const PatchVisibility visibility(scene);
    for (const BasisDegree degree : {BasisDegree::kConstant, BasisDegree::kLinear, BasisDegree::kQuadratic}) {
      DenseOptions options;
      options.degree = degree;
      options.tolerance = 1e-10;
      const DenseSystem system = AssembleDense(UniformForest(scene, 1), visibility, options, {});
      const DenseLight light = SolveDense(system);
      double worst = 0;
      for (std::size_t i = 0; i < system.size(); ++i)
        worst = std::max({worst, std::abs(light.radiosity[i][0] - 1), std::abs(light.irradiance[i][2] - 1)});
      EXPECT_LE(worst, c["rtol"].get<double>()) << c["id"] << " degree " << static_cast<int>(degree);
      const DenseClosure closure = MeasureClosure(system);
      std::printf("%s, degree %d: worst error %.2g, rows off by %.2g, reciprocity by %.2g\n",
                  c["id"].get<std::string>().c_str(), static_cast<int>(degree), worst,
                  std::max(1 - closure.least_row_sum, closure.largest_row_sum - 1), closure.reciprocity);
    }
  }
  EXPECT_EQ(tested, 6);
}

// The rows `internal_reflected` of lighting_analytic.json: the mean irradiance of a closed room, all of it
// and what has been reflected, follows from flux and reflectance alone, wherever the flux comes from.
TEST(DenseTruth, MeanIrradianceOfAClosedRoom) {
  const json truth = Load("lighting_analytic.json");
  Scene scene;
  scene_test::AddMaterial(scene, 0, 0);
  scene_test::AddBox(scene, Vec3::Zero(), Vec3::Constant(4), true, 0);
  const PatchVisibility visibility(scene);
  const DenseSystem system = AssembleDense(UniformForest(scene, 2), visibility, {}, {});
  int tested = 0;
  double worst = 0;
  for (const json& c : truth["cases"]) {
    if (c["id"] != "internal_reflected") continue;
    for (const json& row : c["rows"])
      for (const bool even : {true, false}) {
        // All of the ceiling, or uneven parts of a wall and the floor.
        std::vector<Rgb> emittance(system.size(), Rgb::Zero()),
            reflectance(system.size(), Rgb::Constant(row["rho"].get<double>()));
        for (std::size_t i = 4; i < 8 && even; ++i) emittance[i] = Rgb::Constant(10000.0 / 16);
        if (!even) {
          emittance[1] = Rgb::Constant(3000.0 / 4);
          emittance[10] = Rgb::Constant(7000.0 / 4);
        }
        const DenseLight light = SolveDense(system, emittance, reflectance);
        const std::vector<Rgb> black(system.size(), Rgb::Zero());
        const DenseLight direct = SolveDense(system, emittance, black);
        double total = 0, indirect = 0;
        for (std::size_t i = 0; i < system.size(); ++i) {
          total += light.irradiance[i][1] / static_cast<double>(system.size());
          indirect += (light.irradiance[i][1] - direct.irradiance[i][1]) / static_cast<double>(system.size());
        }
        const double rtol = c["rtol"].get<double>();
        for (const auto& [got, name] :
             {std::pair(total, "mean_total"), std::pair(indirect, "mean_indirect")}) {
          const double want = ToDouble(row[name]);
          EXPECT_NEAR(got, want, rtol * want) << row["rho"] << " " << name;
          if (want > 0) worst = std::max(worst, std::abs(got - want) / want);
        }
        ++tested;
      }
  }
  std::printf("%d rooms, worst relative error %.2g\n", tested, worst);
  EXPECT_EQ(tested, 20);
}

// The largest relative error of the irradiance at the points of a case of radiosity_continuous.json, from the
// leaves of a forest.
double WorstError(const json& c, const ElementForest& forest, const PatchVisibility& visibility,
                  BasisDegree degree, std::size_t* unknowns) {
  DenseOptions options;
  options.degree = degree;
  const DenseSystem system = AssembleDense(forest, visibility, options, {});
  const DenseLight light = SolveDense(system);
  *unknowns = system.size();
  double worst = 0;
  for (const auto& [surface, points] : c["irradiance"].items())
    for (const json& p : points) {
      const auto [patch, position] = UnitPoint(c, surface, p["a"].get<double>(), p["b"].get<double>());
      const ReceiverPoint at = scene_test::Receiver(position, forest.scene().patches[patch].normal);
      const double got = DenseIrradiance(system, light, visibility, patch, at)[0], want = ToDouble(p["H"]);
      worst = std::max(worst, std::abs(got - want) / want);
    }
  return worst;
}

// Where radiosity is smooth, between opposed squares, the irradiance converges with order 2, 4 and 6: twice
// the degree and two.
TEST(DenseTruth, OrdersOfConvergence) {
  const json truth = Load("radiosity_continuous.json");
  for (const json& c : truth["cases"]) {
    if (c["id"] != "par_pair_half") continue;
    const Scene scene = UnitScene(c);
    const PatchVisibility visibility(scene);
    for (const BasisDegree degree : {BasisDegree::kConstant, BasisDegree::kLinear, BasisDegree::kQuadratic}) {
      double before = 0, order = 0;
      for (const int n : {1, 2, 4}) {
        std::size_t unknowns = 0;
        const double error = WorstError(c, UniformForest(scene, n), visibility, degree, &unknowns);
        order = before > 0 ? std::log2(before / error) : 0;
        std::printf("degree %d, n = %d: worst relative error %.3g, order %.2f\n", static_cast<int>(degree), n,
                    error, order);
        before = error;
      }
      EXPECT_GE(order, 2 * static_cast<int>(degree) + 1.5);
    }
  }
}

// Where walls meet radiosity goes as d^0.763 with the distance from the edge: leaves that are halved towards
// the borders of their patches, again and again, meet it. Every point of every case then comes near, those
// 2^-10 from the edges too.
TEST(DenseTruth, GradedTowardsEdges) {
  const json truth = Load("radiosity_continuous.json");
  for (const json& c : truth["cases"]) {
    const Scene scene = UnitScene(c);
    const PatchVisibility visibility(scene);
    std::vector<double> errors;
    for (const int levels : {1, 2, 3}) {
      ElementForest forest = UniformForest(scene, 2);
      for (int level = 1; level < levels; ++level)
        for (const ElementId leaf : forest.AllLeaves()) {
          const auto corners = forest[leaf].Corners();
          if (std::any_of(corners.begin(), corners.end(), [](const LatticePoint& p) {
                return p.x == 0 || p.y == 0 || p.x == kLatticeSize || p.y == kLatticeSize;
              }))
            forest.Subdivide(leaf);
        }
      std::size_t unknowns = 0;
      errors.push_back(WorstError(c, forest, visibility, BasisDegree::kLinear, &unknowns));
      std::printf("%s, %d levels, %zu unknowns: worst relative error %.3g\n",
                  c["id"].get<std::string>().c_str(), levels, unknowns, errors.back());
    }
    EXPECT_LE(errors.back(), 0.5 * errors.front()) << c["id"];
  }
}

}  // namespace
}  // namespace penumbra
