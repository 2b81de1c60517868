// The rows of radiosity_exact.json that are no closed rooms: infinite plates and integrating spheres. By the
// dense solver, and by every variant of the hierarchical one.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/transport/solvers/dense_solver.h"
#include "tests/transport/transport_test_tools.h"
#include "tests/transport/truth_files.h"

namespace penumbra {
namespace {

using namespace truth;

json CaseOf(const json& truth, const std::string& id) {
  for (const json& c : truth["cases"])
    if (c["id"] == id) return c;
  throw std::out_of_range("no case " + id);
}

// Two unit squares that look at each other from `gap` [m] apart.
Scene Plates(const json& c, double gap) {
  Scene scene;
  for (const char* plate : {"1", "2"})
    scene_test::AddMaterial(scene, c[std::string("rho") + plate].get<double>(),
                            c[std::string("E") + plate].get<double>());
  scene_test::Add(scene, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 0);
  scene_test::Add(scene, {{0, 0, gap}, {0, 1, gap}, {1, 1, gap}, {1, 0, gap}}, 1);
  return scene;
}

// The sphere as 20 x 4^levels triangles that look inwards: an icosahedron whose edges are halved, the new
// vertices moved out to the sphere. The first quarter of its faces and of its area has the first material.
Scene Sphere(int levels, const std::array<std::pair<double, double>, 2>& reflectance_and_emittance) {
  Scene scene;
  for (const auto& [reflectance, emittance] : reflectance_and_emittance)
    scene_test::AddMaterial(scene, reflectance, emittance);
  // The five about one vertex, then the five about the opposite one, then those between.
  std::vector<Vec3> v = {Vec3::UnitZ(), -Vec3::UnitZ()};
  const double z = 1 / std::sqrt(5.0), r = 2 / std::sqrt(5.0);
  for (int i = 0; i < 5; ++i) {
    const double a = 2 * std::numbers::pi * i / 5, b = a + std::numbers::pi / 5;
    v.emplace_back(r * std::cos(a), r * std::sin(a), z);
    v.emplace_back(r * std::cos(b), r * std::sin(b), -z);
  }
  std::vector<std::array<Vec3, 3>> faces;
  const auto upper = [&](int i) { return v[2 + 2 * static_cast<std::size_t>(i % 5)]; };
  const auto lower = [&](int i) { return v[3 + 2 * static_cast<std::size_t>(i % 5)]; };
  for (int i = 0; i < 5; ++i) faces.push_back({v[0], upper(i), upper(i + 1)});
  for (int i = 0; i < 5; ++i) faces.push_back({v[1], lower(i + 1), lower(i)});
  for (int i = 0; i < 5; ++i) faces.push_back({upper(i), lower(i), upper(i + 1)});
  for (int i = 0; i < 5; ++i) faces.push_back({lower(i), lower(i + 1), upper(i + 1)});
  for (int level = 0; level < levels; ++level) {
    std::vector<std::array<Vec3, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const Vec3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = std::move(finer);
  }
  for (std::size_t f = 0; f < faces.size(); ++f)
    scene_test::Add(scene, {faces[f][0], faces[f][2], faces[f][1]}, f < faces.size() / 4 ? 0 : 1);
  return scene;
}

// Reflectance and emittance of the quarter that glows, and of the rest.
std::array<std::pair<double, double>, 2> MaterialsOf(const json& c) {
  const double emittance = 4 * c["mean_E"].get<double>();
  const auto rho = [&](std::size_t m) {
    return c.contains("rho") ? c["rho"].get<double>() : c["rho_areas"][m][1].get<double>();
  };
  return {{{rho(0), emittance}, {rho(1), 0}}};
}

// A system whose elements have these areas and whose form factors are given.
DenseSystem System(const Eigen::MatrixXd& transport) {
  DenseSystem system;
  system.transport = transport;
  system.element_of_unknown.resize(static_cast<std::size_t>(transport.rows()));
  std::iota(system.element_of_unknown.begin(), system.element_of_unknown.end(), std::size_t{0});
  return system;
}

constexpr double kDense = 1e-9;  // what is asked of the dense solver, relative

// All form factors of infinite plates are 1. Those of unit squares get there as their gap vanishes, and so
// does their light, by so much for each millionth of a metre: two gaps give the limit, but for terms of
// second order.
TEST(AnalyticTruth, PlatesByTheDenseSolver) {
  const json truth = Load("radiosity_exact.json");
  const json c = CaseOf(truth, "parallel_plates_infinite");
  const std::array<double, 2> want = {ToDouble(c["B1"]), ToDouble(c["B2"])};
  constexpr double kGap = 1e-6;
  std::array<DenseLight, 2> finite;
  std::vector<Rgb> emittance, reflectance;
  for (int i = 0; i < 2; ++i) {
    const Scene scene = Plates(c, (i + 1) * kGap);
    const PatchVisibility visibility(scene);
    finite[static_cast<std::size_t>(i)] =
        SolveDense(AssembleDense(UniformForest(scene, 1), visibility, {}, {}));
    emittance.push_back(scene.materials[static_cast<std::size_t>(i)].emittance);
    reflectance.push_back(scene.materials[static_cast<std::size_t>(i)].reflectance);
  }
  const DenseLight infinite = SolveDense(System(Eigen::Matrix2d{{0, 1}, {1, 0}}), emittance, reflectance);
  for (std::size_t i = 0; i < 2; ++i) {
    const double limit = 2 * finite[0].radiosity[i][0] - finite[1].radiosity[i][0];
    std::printf("plate %zu: off by %.2g, from plates that come together by %.2g, 1e-6 apart by %.2g\n", i + 1,
                infinite.radiosity[i][0] / want[i] - 1, limit / want[i] - 1,
                finite[0].radiosity[i][0] / want[i] - 1);
    EXPECT_NEAR(infinite.radiosity[i][0], want[i], kDense * want[i]);
    EXPECT_NEAR(limit, want[i], kDense * want[i]);
  }
}

// What an element of a sphere gets from another is the other's share of the sphere: irradiance is the same
// everywhere, whatever glows and reflects where, on elements of any size.
TEST(AnalyticTruth, SpheresByTheDenseSolver) {
  const json truth = Load("radiosity_exact.json");
  Random random(700);
  for (const char* id : {"sphere_uniform", "sphere_mixed"}) {
    const json c = CaseOf(truth, id);
    const json materials = c.contains("rho_areas") ? c["rho_areas"] : json{{1, c["rho"]}};
    constexpr Eigen::Index kElements = 12;  // of each material
    const auto n = kElements * static_cast<Eigen::Index>(materials.size());
    Eigen::VectorXd area(n), glow(n);
    std::vector<Rgb> reflectance;
    for (std::size_t m = 0; m < materials.size(); ++m) {
      auto own = area.segment(static_cast<Eigen::Index>(m) * kElements, kElements);
      for (double& a : own) a = random.LogUniform(0.01, 1);
      own *= materials[m][0].get<double>() / own.sum();
      reflectance.insert(reflectance.end(), kElements, Rgb::Constant(materials[m][1].get<double>()));
    }
    for (double& e : glow) e = random.Uniform();
    glow *= c["mean_E"].get<double>() / area.dot(glow);
    std::vector<Rgb> emittance;
    for (const double e : glow) emittance.push_back(Rgb::Constant(e));
    const DenseLight light =
        SolveDense(System(Eigen::VectorXd::Ones(n) * area.transpose()), emittance, reflectance);
    const double want = ToDouble(c["H"]);
    double worst = 0;
    for (const Rgb& irradiance : light.irradiance)
      worst = std::max(worst, std::abs(irradiance[1] / want - 1));
    std::printf("%s: worst relative error %.2g\n", id, worst);
    EXPECT_LE(worst, kDense) << id;
  }
}

// The area's mean irradiance.
template <class Irradiance>
double Mean(const std::vector<double>& area, const Irradiance& irradiance) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    sum += area[i] * irradiance(i);
    total += area[i];
  }
  return sum / total;
}

// A quarter of a sphere glows, and reflects as much as the rest, or more. Of 20 or 80 flat faces: with one
// reflectance the mean irradiance is that of the sphere to roundings, for all light is kept; with two it
// comes nearer with the square of the faces' size.
TEST(AnalyticTruth, FacesOfASphereByTheDenseSolver) {
  const json truth = Load("radiosity_exact.json");
  for (const char* id : {"sphere_uniform", "sphere_mixed"}) {
    const double want = ToDouble(CaseOf(truth, id)["H"]);
    std::vector<double> off;
    for (const int levels : {0, 1}) {
      const Scene scene = Sphere(levels, MaterialsOf(CaseOf(truth, id)));
      const PatchVisibility visibility(scene);
      const DenseLight light = SolveDense(AssembleDense(UniformForest(scene, 1), visibility, {}, {}));
      std::vector<double> area;
      for (const Patch& patch : scene.patches) area.push_back(patch.area);
      off.push_back(std::abs(Mean(area, [&](std::size_t i) { return light.irradiance[i][0]; }) / want - 1));
      std::printf("%s, %zu faces: mean irradiance off by %.2g\n", id, scene.patches.size(), off.back());
      if (id == std::string("sphere_uniform")) {
        EXPECT_LE(off.back(), kDense);
      }
    }
    if (id == std::string("sphere_mixed")) {
      EXPECT_LE(off[1], 0.5 * off[0]);
    }
  }
}

struct Variant {
  std::string name;
  SolverOptions options;
};

// All combinations of oracle, multigridding, iteration and acceleration.
std::vector<Variant> Variants(const std::string& form_factors) {
  std::vector<Variant> variants;
  for (const std::string& oracle : scene_test::kOracles)
    for (const bool multigrid : {false, true})
      for (const IterationScheme scheme : {IterationScheme::kJacobi, IterationScheme::kGaussSeidel})
        for (const Acceleration acceleration : {Acceleration::kNone, Acceleration::kAnderson}) {
          Variant& variant = variants.emplace_back();
          variant.options.oracle = oracle;
          variant.options.multigrid = multigrid;
          variant.options.scheme = scheme;
          variant.options.acceleration = acceleration;
          variant.options.form_factors = form_factors;
          variant.name = oracle + (multigrid ? ", multigrid" : "") +
                         (scheme == IterationScheme::kJacobi ? ", Jacobi" : ", Gauss-Seidel") +
                         (acceleration == Acceleration::kNone ? "" : ", Anderson") + ", " + form_factors;
        }
  return variants;
}

// What is asked of the hierarchical solver, relative: the program's default. Its eps follows as there: twice
// that of the mean irradiance.
constexpr double kAsked = 0.02;
// The smallest element [m^2]. Without one the thesis's oracle, which has no weight by area, would divide for
// ever where faces meet.
constexpr double kMinArea = 0.02;

// Solves by the variant, and looks at the light with or without corrections.
void ExpectSolved(Variant variant, const Scene& scene, const PatchVisibility& visibility,
                  double mean_irradiance,
                  const std::function<void(const RadiositySolution&, const std::string&)>& look) {
  variant.options.eps = 2 * kAsked * mean_irradiance;
  variant.options.relative_cutoff = 0.005 * kAsked;
  variant.options.min_area = kMinArea;
  for (const int corrections : {0, 2}) {
    variant.options.max_corrections = corrections;
    HierarchicalSolver solver(scene, visibility, variant.options);
    solver.Solve({});
    EXPECT_TRUE(solver.Converged()) << variant.name;
    look(solver.solution(), variant.name + (corrections > 0 ? ", corrected" : ", links alone"));
  }
}

// Plates a thousandth apart as near to infinite ones as is asked.
TEST(AnalyticTruth, PlatesByEveryVariant) {
  const json truth = Load("radiosity_exact.json");
  const json c = CaseOf(truth, "parallel_plates_infinite");
  const Scene scene = Plates(c, 1e-3);
  const PatchVisibility visibility(scene);
  const std::array<double, 2> want = {ToDouble(c["B1"]), ToDouble(c["B2"])};
  double worst = 0;
  for (const std::string form_factors : {"cubature", "exact"})
    for (const Variant& variant : Variants(form_factors))
      ExpectSolved(variant, scene, visibility, 0.5 * (want[0] + want[1]),
                   [&](const RadiositySolution& solution, const std::string& name) {
                     for (std::size_t p = 0; p < 2; ++p) {
                       const double off = std::abs(solution.radiosity[p][0] / want[p] - 1);
                       EXPECT_LE(off, kAsked) << name;
                       worst = std::max(worst, off);
                     }
                   });
  std::printf("worst relative error %.2g of %.2g\n", worst, kAsked);
}

// A sphere of flat faces as near to a round one, in the mean, as is asked: of 20 faces, where one reflectance
// makes the mean that of the sphere, and of 80, where two reflectances do within that, by one variant of each
// oracle.
TEST(AnalyticTruth, SpheresByEveryVariant) {
  const json truth = Load("radiosity_exact.json");
  const auto solve = [&](const std::string& id, int levels, const std::vector<Variant>& variants) {
    const Scene scene = Sphere(levels, MaterialsOf(CaseOf(truth, id)));
    const PatchVisibility visibility(scene);
    const double want = ToDouble(CaseOf(truth, id)["H"]);
    std::vector<double> area;
    for (const Patch& patch : scene.patches) area.push_back(patch.area);
    double worst = 0;
    for (const Variant& variant : variants)
      ExpectSolved(variant, scene, visibility, want,
                   [&](const RadiositySolution& solution, const std::string& name) {
                     // Roots come first, and have the means of their leaves.
                     const double mean = Mean(area, [&](std::size_t i) { return solution.irradiance[i][0]; });
                     EXPECT_NEAR(mean, want, kAsked * want) << id << ", " << name;
                     worst = std::max(worst, std::abs(mean / want - 1));
                   });
    std::printf("%s, %zu faces, %zu variant(s): worst relative error %.2g of %.2g\n", id.c_str(),
                scene.patches.size(), variants.size(), worst, kAsked);
  };
  solve("sphere_uniform", 0, Variants("cubature"));
  // One for each oracle; by exact links, which cost seconds between faces at flat angles, the first.
  std::vector<Variant> some = Variants("cubature");
  std::erase_if(some, [](const Variant& variant) {
    return variant.options.multigrid || variant.options.scheme != IterationScheme::kJacobi ||
           variant.options.acceleration != Acceleration::kAnderson;
  });
  Variant exact = some[0];
  exact.options.form_factors = "exact";
  exact.name += ", but exact";
  solve("sphere_uniform", 0, {exact});
  solve("sphere_mixed", 1, some);
}

}  // namespace
}  // namespace penumbra
