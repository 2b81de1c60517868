// Sweeps and the bound of what they leave.

#include "solver/transport/solvers/settling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <tuple>

#include "solver/base/parallel.h"
#include "solver/transport/solvers/closure.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

// The links of a furnished room, dark.
RadiositySolution DarkRoom(Scene& scene, double reflectance, std::uint64_t seed) {
  Random random(seed);
  scene = FurnishedRoom(random, 2);
  for (Material& material : scene.materials)
    material.reflectance =
        material.emittance[0] > 0 ? Rgb::Zero().eval() : Rgb(reflectance, 0.9 * reflectance, 0);
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.eps = 3;
  options.max_corrections = 0;
  HierarchicalSolver solver(scene, visibility, options);
  solver.Solve(ExecutionContext());
  RadiositySolution solution = solver.solution();
  return solution;
}

void Darken(RadiositySolution& solution) {
  PushPull push_pull(solution);
  for (const ElementId leaf : push_pull.leaves()) push_pull.Light(leaf, Rgb::Zero());
  push_pull.Pull();
}

double LargestDifference(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).abs().maxCoeff());
  return largest;
}

// All schemes lead to the same light, and what is missing at any cut-off is at most the residual they tell.
// Gauss-Seidel takes fewer sweeps than Jacobi, and guessing ahead fewer than either alone in bright rooms.
TEST(Settling, ResidualBoundsWhatIsMissing) {
  for (const double reflectance : {0.3, 0.9, 0.99}) {
    Scene scene;
    const RadiositySolution linked = DarkRoom(scene, reflectance, 2001);
    RadiositySolution exact = linked;
    PushPull whole(exact);
    Settle(whole, exact, {}, {IterationScheme::kJacobi, Acceleration::kAnderson, 1e-13}, {});
    const double reflected = whole.LargestReflected();
    std::printf("seed 2001, reflectance %.2f:", reflectance);
    std::size_t sweeps[2][2];
    for (const auto scheme : {IterationScheme::kJacobi, IterationScheme::kGaussSeidel})
      for (const auto acceleration : {Acceleration::kNone, Acceleration::kAnderson})
        for (const double cutoff : {1e-1, 1e-2, 1e-4, 1e-6}) {
          RadiositySolution solution = linked;
          Darken(solution);
          PushPull push_pull(solution);
          const Settled settled = Settle(push_pull, solution, {}, {scheme, acceleration, cutoff}, {});
          EXPECT_LE(settled.residual, cutoff);
          const double missing = LargestDifference(solution.radiosity, exact.radiosity);
          // The residual is relative to what the light reflects now; 1e-12 is the rounding of some sweeps.
          EXPECT_LE(missing, settled.residual * push_pull.LargestReflected() + 1e-12 * reflected);
          sweeps[static_cast<int>(scheme)][static_cast<int>(acceleration)] = settled.sweeps;
        }
    std::printf(" to 1e-6 Jacobi %zu sweeps, accelerated %zu, Gauss-Seidel %zu, accelerated %zu\n",
                sweeps[0][0], sweeps[0][1], sweeps[1][0], sweeps[1][1]);
    EXPECT_LT(sweeps[1][0], sweeps[0][0]);
    if (reflectance > 0.8) {
      EXPECT_LT(sweeps[0][1], sweeps[1][0]);
      EXPECT_LE(sweeps[1][1], sweeps[0][1]);
    }
  }
}

// The bound of the light to come is one, and near: it exceeds the largest sum of M + M^2 + ... by a tenth at
// most. Between the walls of a closed box of reflectance r that is r / (1 - r), to the links' 1e-4; without
// one wall it is less. Among leaves it is more, since some keep the form factors of their parents.
TEST(Settling, LightToComeIsBound) {
  constexpr double kReflectance = 0.75;
  Scene box;
  AddMaterial(box, kReflectance, 1);
  AddBox(box, Vec3::Zero(), {2, 1, 1}, true, 0);
  for (const bool open : {false, true})
    for (const double eps : {1e9, 1.0}) {
      Scene scene = box;
      if (open) scene.patches.pop_back();
      RadiositySolution solution = Solved(scene, eps);
      const PushPull push_pull(solution);
      const double bound = LightToCome(push_pull, solution).maxCoeff();
      std::vector<Rgb> term(solution.forest.size(), Rgb::Ones()), sum(term.size(), Rgb::Zero());
      for (int k = 0; k < 200; ++k) {
        term = push_pull.Transport(term);
        for (std::size_t e = 0; e < term.size(); ++e) sum[e] += term[e] *= kReflectance;
      }
      double exact = 0;
      for (const ElementId leaf : push_pull.leaves()) exact = std::max(exact, sum[leaf].maxCoeff());
      std::printf("%s box: %zu leaves, light to come %.5g, bound %.5g, of a closed one 3\n",
                  open ? "open" : "closed", push_pull.leaves().size(), exact, bound);
      EXPECT_GE(bound, exact * (1 - 1e-12));
      EXPECT_LE(bound, 1.1 * exact);
      if (eps < 1e9) continue;
      if (open)
        EXPECT_LT(exact, 2.5);
      else
        EXPECT_NEAR(exact, 3, 3e-3);  // an error of 1e-4 in the form factors' sum counts r / (1 - r)^2-fold
    }
}

// Gauss-Seidel has a fixed order: the same bytes for one thread, two and five.
TEST(Settling, GaussSeidelIsTheSameForAnyThreadCount) {
  Scene scene;
  const RadiositySolution linked = DarkRoom(scene, 0.8, 2002);
  std::vector<Rgb> first;
  for (const int threads : {1, 2, 5}) {
    SetThreadCount(threads);
    RadiositySolution solution = linked;
    Darken(solution);
    PushPull push_pull(solution);
    Settle(push_pull, solution, {}, {IterationScheme::kGaussSeidel, Acceleration::kAnderson, 1e-6}, {});
    if (threads == 1) first = solution.radiosity;
    EXPECT_EQ(std::memcmp(first.data(), solution.radiosity.data(), first.size() * sizeof(Rgb)), 0);
  }
  SetThreadCount(0);
}

// The transport of the links is linear, and bounces add up to the light: emittance and all that it brings.
TEST(Settling, BouncesAddUp) {
  Random random(2003);
  const Scene scene = FurnishedRoom(random, 3);
  const PatchVisibility visibility(scene);
  SolverOptions options;
  options.eps = 2;
  options.relative_cutoff = 1e-10;
  HierarchicalSolver solver(scene, visibility, options);
  while (!solver.Converged()) solver.Iterate(ExecutionContext());
  const std::vector<Rgb> bounces = solver.MeanIrradianceByBounce(60);
  ASSERT_EQ(bounces.size(), 60U);
  Rgb sum = Rgb::Zero(), mean = Rgb::Zero();
  double area = 0;
  for (const Rgb& bounce : bounces) sum += bounce;
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    mean += scene.patches[p].area * solver.solution().irradiance[p];
    area += scene.patches[p].area;
  }
  // Each bounce carries half the last one's light at most: 2^-60 is left.
  EXPECT_LE((sum - mean / area).abs().maxCoeff(), 1e-9 * sum.maxCoeff());
  for (std::size_t k = 1; k < bounces.size(); ++k) EXPECT_LE(bounces[k][0], 0.55 * bounces[k - 1][0]);
}

// Settling ends, whatever is asked: where roundings let the light come no nearer, and where it grows without
// end on links that bring more than there is.
TEST(Settling, Ends) {
  Scene scene;
  RadiositySolution solution = DarkRoom(scene, 0.9, 2003);
  {
    PushPull push_pull(solution);
    const Settled settled =
        Settle(push_pull, solution, {}, {IterationScheme::kJacobi, Acceleration::kNone, 0}, {});
    EXPECT_LE(settled.residual, 1e-13);
    EXPECT_LT(settled.sweeps, 1000U);
  }
  for (Link& link : solution.links.links) link.form_factor *= 1.2;
  PushPull push_pull(solution);
  const Settled settled =
      Settle(push_pull, solution, {}, {IterationScheme::kJacobi, Acceleration::kNone, 1e-3}, {});
  EXPECT_GT(settled.residual, 1e-3);
  EXPECT_LT(settled.sweeps, 1000U);
}

// Links in balance bring unit radiosity everywhere back as what the room closes: in a closed room as 1, to
// rounding, whatever the links' own sums are.
TEST(Settling, BalancedLinksClose) {
  Scene scene;
  RadiositySolution solution = DarkRoom(scene, 0.9, 2004);
  const PatchVisibility visibility(scene);
  PushPull push_pull(solution);
  const std::vector<double> closure = LeafClosures(solution.forest, visibility, push_pull.leaves(), {});
  push_pull.Balance(closure);
  const std::vector<Rgb> sum = push_pull.Transport(std::vector<Rgb>(solution.forest.size(), Rgb::Ones()));
  double worst = 0;
  for (std::size_t i = 0; i < push_pull.leaves().size(); ++i)
    worst = std::max(worst, std::abs(sum[push_pull.leaves()[i]][0] - closure[i]));
  std::printf("seed 2004: %zu leaves, worst %.1e\n", closure.size(), worst);
  EXPECT_LE(worst, 1e-14);
  for (const double share : closure) EXPECT_LE(share, 1 + 1e-12);
  EXPECT_NEAR(*std::max_element(closure.begin(), closure.end()), 1, 1e-12);
}

}  // namespace
}  // namespace penumbra::scene_test
