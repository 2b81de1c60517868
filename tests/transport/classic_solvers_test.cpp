// The solvers on uniform meshes: furnaces, energy after every step, agreement with the direct solution, and
// overshooting.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "solver/base/parallel.h"
#include "solver/scene/builtin_scenes.h"
#include "solver/transport/solvers/dense_solver.h"
#include "solver/transport/solvers/light_solvers.h"
#include "solver/transport/solvers/progressive_solver.h"
#include "solver/transport/solvers/rayrad_solver.h"
#include "tests/transport/ashdown_room.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

const std::vector<std::string> kClassic = {"progressive", "full-matrix", "stochastic", "rayrad"};

UniformOptions UniformlyBy(const std::string& form_factors, int divisions, double cutoff = 1e-10) {
  UniformOptions options;
  options.form_factors = form_factors;
  options.form_factor_options.factors_only = true;
  options.divisions = divisions;
  options.relative_cutoff = cutoff;
  return options;
}

// A solver of its own for a scene, solved to the end.
struct SolverRun {
  SolverRun(const Scene& scene, const std::string& name, const UniformOptions& uniform) : visibility(scene) {
    LightSolverOptions options;
    options.uniform = uniform;
    options.dense.divisions = uniform.divisions;
    const PairFinder pairs = [this](const ExecutionContext&) -> const PatchVisibility& { return visibility; };
    solver = LightSolvers().Make(name, {scene, pairs}, options, ExecutionContext());
    whole = SolveStepByStep(*solver, ExecutionContext());
  }
  const RadiositySolution& solution() const { return solver->solution(); }
  std::size_t steps() const { return solver->report().iterations.size(); }

  PatchVisibility visibility;
  std::unique_ptr<LightSolver> solver;
  bool whole = false;
};

Scene FurnaceOf(double reflectance, double emittance) {
  Scene scene;
  AddMaterial(scene, reflectance, emittance);
  AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, 0);
  return scene;
}

// A room of 2 x 3 x 2.5 m with a lamp in the ceiling's place and coloured walls.
Scene RoomWithALamp() {
  Scene scene;
  AddMaterial(scene, 0.6, 0);
  AddMaterial(scene, 0.2, 10);
  scene.materials[0].reflectance = {0.6, 0.5, 0.4};
  AddBox(scene, Vec3::Zero(), {2, 3, 2.5}, true, {0, 1, 0, 0, 0, 0});
  return scene;
}

// The area-weighted root mean square difference of the leaves' irradiances, relative to that of the
// irradiance.
double RelativeDifference(const RadiositySolution& a, const RadiositySolution& b) {
  double difference = 0, square = 0;
  EXPECT_EQ(a.forest.size(), b.forest.size());
  for (const ElementId leaf : a.forest.AllLeaves()) {
    const auto e = static_cast<std::size_t>(leaf);
    difference += a.forest[leaf].area * (a.irradiance[e] - b.irradiance[e]).square().sum();
    square += a.forest[leaf].area * b.irradiance[e].square().sum();
  }
  return std::sqrt(difference / square);
}

// In a closed room of one material every radiosity is E / (1 - rho). Gathering finds it with any form factors
// of a receiver that add up to 1, and shooting if they are exact.
TEST(ClassicSolvers, FindTheFurnaceExactly) {
  const Scene scene = FurnaceOf(0.5, 3);
  const std::map<std::string, std::vector<std::string>> methods = {
      {"full-matrix", {"exact", "hemicube", "cubic-tetrahedron", "malley"}}, {"progressive", {"exact"}}};
  for (const auto& [solver, all] : methods)
    for (const std::string& form_factors : all) {
      const SolverRun run(scene, solver, UniformlyBy(form_factors, form_factors == "exact" ? 1 : 2));
      EXPECT_TRUE(run.whole && run.solver->Converged()) << solver;
      for (const Rgb& radiosity : run.solution().radiosity)
        EXPECT_NEAR(radiosity[0], 6, 1e-7) << solver << " " << form_factors;
    }
  // In whole rooms rays hit the walls in proportion to what they receive.
  UniformOptions options = UniformlyBy("cubature", 1, 1e-6);
  options.form_factor_options.rays = 20'000;
  const SolverRun stochastic(scene, "stochastic", options);
  double flux = 0;
  for (PatchId p = 0; p < 6; ++p)
    flux += scene.patches[p].area * stochastic.solution().radiosity[static_cast<std::size_t>(p)][0];
  double area = 0;
  for (const Patch& patch : scene.patches) area += patch.area;
  EXPECT_NEAR(flux / area, 6, 1e-4) << "no ray is lost in a closed room";
  for (const Rgb& radiosity : stochastic.solution().radiosity) EXPECT_NEAR(radiosity[0], 6, 0.05);
}

// The matrix and the shots with exact form factors have the solution of the direct solver as their limit;
// patches that shoot as a whole keep the fluxes, but not the detail, of elements that shoot.
TEST(ClassicSolvers, AgreeWithTheDirectSolution) {
  const Scene scene = RoomWithALamp();
  const SolverRun dense(scene, "dense", UniformlyBy("exact", 2));
  const SolverRun direct(scene, "dense", UniformlyBy("exact", 1));
  UniformOptions sweeps = UniformlyBy("exact", 1);
  const SolverRun jacobi(scene, "full-matrix", sweeps);
  sweeps.scheme = IterationScheme::kGaussSeidel;
  const SolverRun seidel(scene, "full-matrix", sweeps);
  EXPECT_LT(RelativeDifference(jacobi.solution(), direct.solution()), 1e-8);
  EXPECT_LT(RelativeDifference(seidel.solution(), direct.solution()), 1e-8);
  EXPECT_LT(seidel.steps(), jacobi.steps());
  const std::map<std::string, double> bounds = {{"progressive", 0.12}, {"stochastic", 0.03}};
  for (const auto& [solver, bound] : bounds) {
    UniformOptions options = UniformlyBy("cubature", 2, 1e-6);
    if (solver == "stochastic") options.form_factor_options.rays = 20'000;
    const SolverRun run(scene, solver, options);
    const double difference = RelativeDifference(run.solution(), dense.solution());
    std::printf("%s: %.4f, %zu steps\n", solver.c_str(), difference, run.steps());
    EXPECT_LT(difference, bound) << solver;
  }
  // With whole patches as elements the two systems are one.
  const SolverRun whole(scene, "progressive", UniformlyBy("exact", 1, 1e-12));
  EXPECT_LT(RelativeDifference(whole.solution(), direct.solution()), 1e-8);
}

// Cornell box, coarse, past blockers: every classic solver with every kind of form factors lies near the
// direct solution.
TEST(ClassicSolvers, AgreeInTheCornellBox) {
  const Scene scene = *LoadBuiltinScene("cornell", {});
  const SolverRun dense(scene, "dense", UniformlyBy("exact", 1, 1e-6));
  const std::map<std::string, double> bounds = {
      {"cubature", 0.03}, {"hemicube", 0.08},    {"cubic-tetrahedron", 0.08}, {"rays", 0.12},
      {"malley", 0.2},    {"monte-carlo", 0.12}, {"contour", 0.08},           {"disk", 0.4}};
  for (const auto& [form_factors, bound] : bounds) {
    const SolverRun run(scene, "full-matrix", UniformlyBy(form_factors, 1, 1e-6));
    const double difference = RelativeDifference(run.solution(), dense.solution());
    std::printf("full-matrix, %s: %.4f\n", form_factors.c_str(), difference);
    EXPECT_LT(difference, bound) << form_factors;
  }
}

// Emitted = absorbed + unsent after every shot in a closed room, with and without overshooting.
TEST(ShootingSolver, KeepsTheEnergyInEveryShot) {
  const Scene scene = RoomWithALamp();
  const PatchVisibility visibility(scene);
  for (const bool overshoot : {false, true})
    for (const auto& [form_factors, bound] :
         std::map<std::string, double>{{"exact", 1e-9}, {"hemicube", 1e-9}, {"cubic-tetrahedron", 1e-9}}) {
      UniformOptions options = UniformlyBy(form_factors, 2, 1e-4);
      options.overshoot = overshoot;
      ProgressiveSolver solver(scene, visibility, options, ExecutionContext());
      double worst = 0, before = INFINITY;
      while (solver.Next()) {
        ASSERT_TRUE(solver.Step(SolverStep::kIterate, ExecutionContext()));
        const ShootingSolver::Ledger ledger = solver.Balance();
        const Rgb lost = ledger.emitted - ledger.absorbed - ledger.unsent;
        worst = std::max(worst, lost.abs().maxCoeff() / ledger.emitted.maxCoeff());
        if (!overshoot) {
          EXPECT_LE(solver.report().iterations.back().residual, before * (1 + 1e-12));
        }
        before = solver.report().iterations.back().residual;
      }
      EXPECT_LE(worst, bound) << form_factors << (overshoot ? " with overshooting" : "");
      EXPECT_TRUE(solver.Converged());
    }
}

// The ambient light is what the unsent light comes to in a room of one colour: in the furnace it is the whole
// truth before the first shot, and shows without changing what is solved.
TEST(ShootingSolver, AmbientLightIsShownOnly) {
  const Scene scene = FurnaceOf(0.5, 3);
  const PatchVisibility visibility(scene);
  UniformOptions options = UniformlyBy("exact", 2, 1e-9);
  const ProgressiveSolver plain(scene, visibility, options, ExecutionContext());
  EXPECT_NEAR(plain.AmbientIrradiance()[0], 6, 1e-12);
  options.ambient = true;
  ProgressiveSolver shown(scene, visibility, options, ExecutionContext());
  for (const Rgb& radiosity : shown.solution().radiosity) EXPECT_NEAR(radiosity[0], 6, 1e-12);
  ASSERT_TRUE(SolveStepByStep(shown, ExecutionContext()));
  options.ambient = false;
  ProgressiveSolver same(scene, visibility, options, ExecutionContext());
  ASSERT_TRUE(SolveStepByStep(same, ExecutionContext()));
  EXPECT_EQ(shown.report().iterations.size(), same.report().iterations.size());
  EXPECT_LT(RelativeDifference(shown.solution(), same.solution()), 1e-8);
}

// Numbers of Ashdown's room, as counted and computed independently of this program.
TEST(AshdownRoom, HasItsNumbers) {
  const Scene scene = AshdownRoom();
  EXPECT_EQ(scene.patches.size(), 48U);
  double area = 0;
  Rgb reflectance = Rgb::Zero(), flux = Rgb::Zero();
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Material& material = scene.MaterialOf(static_cast<PatchId>(p));
    area += scene.patches[p].area;
    reflectance += scene.patches[p].area * material.reflectance;
    flux += scene.patches[p].area * material.emittance;
  }
  EXPECT_NEAR(area, 9.624352, 1e-6);
  const Rgb mean = reflectance / area;
  EXPECT_NEAR(mean[0], 0.655629, 1e-6);
  EXPECT_NEAR(mean[1], 0.592965, 1e-6);
  EXPECT_NEAR(mean[2], 0.588715, 1e-6);
  for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(flux[channel], 0.12, 1e-12);
  const PatchVisibility visibility(scene);
  const ProgressiveSolver solver(scene, visibility, UniformlyBy("hemicube", 1), ExecutionContext());
  const Rgb ambient = solver.AmbientIrradiance();
  EXPECT_NEAR(ambient[0], 0.036206, 1e-6);
  EXPECT_NEAR(ambient[1], 0.030632, 1e-6);
  EXPECT_NEAR(ambient[2], 0.030316, 1e-6);
}

// Shots until |the sum of unsent fluxes|, negative ones included, is a thousandth of what is emitted:
// Ashdown's way to stop.
std::size_t ShotsUntilSumIsSmall(const Scene& scene, bool overshoot) {
  const PatchVisibility visibility(scene);
  UniformOptions options = UniformlyBy("hemicube", 2, 1e-4);
  options.form_factor_options.resolution = 60;
  options.overshoot = overshoot;
  ProgressiveSolver solver(scene, visibility, options, ExecutionContext());
  while (solver.Next() && solver.Step(SolverStep::kIterate, ExecutionContext())) {
    const ShootingSolver::Ledger ledger = solver.Balance();
    if (std::abs(ledger.unsent.sum()) <= 1e-3 * ledger.emitted.sum()) break;
  }
  return solver.report().iterations.size();
}

// Overshooting takes fewer shots: Ashdown's room needed 120 without it and 74 to 77 with it in an independent
// run; a ratio of 1.6. The ratio depends on what stops the method: the sum of absolute values, as here, or
// the sum in which negative fluxes cancel positive ones, as printed, which ends too early: Ashdown says 40
// to 50. Few elements do: shots depend on patches.
TEST(AshdownRoom, OvershootingTakesFewerShots) {
  const Scene scene = AshdownRoom();
  const std::size_t slow = ShotsUntilSumIsSmall(scene, false), fast = ShotsUntilSumIsSmall(scene, true);
  UniformOptions options = UniformlyBy("hemicube", 2, 1e-3);
  options.form_factor_options.resolution = 60;
  const SolverRun plain(scene, "progressive", options);
  options.overshoot = true;
  const SolverRun faster(scene, "progressive", options);
  std::printf("%zu shots, %zu with overshooting; %zu and %zu by the signed sum\n", plain.steps(),
              faster.steps(), slow, fast);
  EXPECT_TRUE(plain.solver->Converged() && faster.solver->Converged());
  EXPECT_EQ(plain.steps(), slow) << "nothing is negative without overshooting";
  EXPECT_NEAR(static_cast<double>(slow), 120, 12);
  EXPECT_NEAR(static_cast<double>(fast), 45, 10);
  EXPECT_NEAR(static_cast<double>(plain.steps()) / static_cast<double>(faster.steps()), 1.4, 0.15);
  EXPECT_LT(RelativeDifference(faster.solution(), plain.solution()), 0.01);
}

// A vertex that several elements share exists once.
TEST(RayradSolver, SharesVertices) {
  const Scene scene = FurnaceOf(0.5, 3);
  const PatchVisibility visibility(scene);
  const RayradSolver solver(scene, visibility, UniformlyBy("cubature", 4), ExecutionContext());
  EXPECT_EQ(solver.VertexCount(), 6U * 25);
}

// The mean radiosity that RayRad finds in a furnace whose radiosity is 6.
double RayradMean(int divisions, std::size_t rays) {
  const Scene scene = FurnaceOf(0.5, 3);
  UniformOptions options = UniformlyBy("cubature", divisions, 1e-6);
  options.form_factor_options.rays = rays;
  const SolverRun run(scene, "rayrad", options);
  double flux = 0, area = 0;
  for (const ElementId leaf : run.solution().forest.AllLeaves()) {
    flux += run.solution().forest[leaf].area * run.solution().radiosity[static_cast<std::size_t>(leaf)][0];
    area += run.solution().forest[leaf].area;
  }
  return flux / area;
}

// Two faults of the method lose light where walls meet: a vertex in the plane of the shooter receives nothing
// from it, and the printed formula is too small near it. Smaller elements mend the first, more rays the
// second.
TEST(RayradSolver, LosesLightWhereWallsMeet) {
  const double coarse = RayradMean(4, 256), fine = RayradMean(16, 256), few = RayradMean(16, 16);
  std::printf(
      "mean radiosity with 256 rays %.3f, with smaller elements %.3f, with 16 rays %.3f; 6 is right\n",
      coarse, fine, few);
  EXPECT_LT(fine, 6);
  EXPECT_GT((6 - coarse) / (6 - fine), 1.7);
  EXPECT_LT(few, fine);
}

// The bytes do not depend on the number of threads, and a cancelled step leaves the light as it was.
TEST(ClassicSolvers, AreDeterministicAndCancel) {
  const Scene scene = AshdownRoom();
  for (const std::string& solver : kClassic) {
    UniformOptions options = UniformlyBy(solver == "progressive" ? "hemicube" : "rays", 2, 1e-2);
    options.shots = 6;
    SetThreadCount(1);
    const SolverRun alone(scene, solver, options);
    SetThreadCount(3);
    const SolverRun three(scene, solver, options);
    SetThreadCount(0);
    for (std::size_t e = 0; e < alone.solution().irradiance.size(); ++e)
      ASSERT_TRUE((alone.solution().irradiance[e] == three.solution().irradiance[e]).all()) << solver;
    ExecutionContext cancelled;
    cancelled.Cancel();
    const std::vector<Rgb> before = three.solution().irradiance;
    // A new shot needs form factors that it cannot have; a sweep does not begin.
    EXPECT_FALSE(three.solver->Step(SolverStep::kCorrect, ExecutionContext()));
    if (three.solver->Step(SolverStep::kIterate, cancelled)) continue;
    for (std::size_t e = 0; e < before.size(); ++e)
      EXPECT_TRUE((before[e] == three.solution().irradiance[e]).all()) << solver;
  }
}

// The standard error that is told for a mean of bundles holds, and falls with their number.
TEST(StochasticSolver, TellsItsError) {
  const Scene scene = RoomWithALamp();
  const SolverRun dense(scene, "dense", UniformlyBy("exact", 2));
  UniformOptions options = UniformlyBy("cubature", 2, 1e-6);
  options.form_factor_options.rays = 5000;
  for (const std::size_t bundles : {8U, 64U}) {
    options.shots = bundles;
    const SolverRun run(scene, "stochastic", options);
    const double told = run.solver->report().iterations.back().residual,
                 off = RelativeDifference(run.solution(), dense.solution());
    std::printf("%zu bundles: off by %.4f, told %.4f\n", bundles, off, told);
    EXPECT_LT(off, 2 * told + 0.002);
    EXPECT_EQ(run.steps(), bundles);
  }
}

}  // namespace
}  // namespace penumbra::scene_test
