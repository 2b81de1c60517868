// Oracles and what they refine, in random rooms.

#include "solver/transport/links/refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "solver/transport/solvers/energy.h"
#include "tests/transport/transport_test_tools.h"

namespace penumbra::scene_test {
namespace {

using Pair = std::pair<ElementId, ElementId>;

// The patches that a segment passes through between its ends.
std::vector<PatchId> Crossed(const Scene& scene, const Vec3& p, const Vec3& q) {
  std::vector<PatchId> crossed;
  for (PatchId k = 0; k < static_cast<PatchId>(scene.patches.size()); ++k) {
    const Patch& patch = scene.patches[static_cast<std::size_t>(k)];
    const double hp = patch.normal.dot(p - patch.vertex[0]), hq = patch.normal.dot(q - patch.vertex[0]);
    if (std::abs(hp) < 1e-9 || std::abs(hq) < 1e-9 || hp * hq >= 0) continue;
    if (ConvexContains(patch.Vertices(), patch.normal, p + (q - p) * (hp / (hp - hq)), -1e-9))
      crossed.push_back(k);
  }
  return crossed;
}

Vec3 PointIn(Random& random, const Element& element) {
  const double s = random.Uniform(0, 1), t = random.Uniform(0, 1);
  const std::array<Vec3, 4>& v = element.vertex;
  if (element.size == 4) return (1 - s) * ((1 - t) * v[0] + t * v[3]) + s * ((1 - t) * v[1] + t * v[2]);
  return s + t > 1 ? Vec3(v[0] + (1 - s) * (v[1] - v[0]) + (1 - t) * (v[2] - v[0]))
                   : Vec3(v[0] + s * (v[1] - v[0]) + t * (v[2] - v[0]));
}

using BlockersOfLinks = std::map<Pair, std::vector<PatchId>>;

BlockersOfLinks AllBlockers(const LinkSet& links) {
  BlockersOfLinks all;
  for (const Link& link : links.links) {
    const std::span<const PatchId> own = links.Blockers(link);
    all[{link.receiver, link.source}] = {own.begin(), own.end()};
  }
  return all;
}

// Every link has come from one of those before, and its blockers from that one's.
void ExpectInherited(const RadiositySolution& solution, const BlockersOfLinks& before) {
  const ElementForest& forest = solution.forest;
  for (const Link& link : solution.links.links) {
    const std::vector<PatchId>* parent = nullptr;
    for (ElementId r = link.receiver; r != kNoElement; r = forest[r].parent)
      for (ElementId s = link.source; s != kNoElement; s = forest[s].parent)
        if (const auto found = before.find({r, s}); found != before.end()) parent = &found->second;
    ASSERT_NE(parent, nullptr);
    EXPECT_TRUE(std::ranges::includes(*parent, solution.links.Blockers(link)));
  }
}

// By every oracle, with and without multigridding: the solution converges; every pair of leaves is linked at
// most once, and at least once if points of theirs see each other; what stands between two points is among
// the blockers of the link that joins them; a new link's blockers are among those of the link it came from.
TEST(Refinement, CoversOnceAndKeepsBlockers) {
  Random random(3001);
  std::size_t pairs = 0, blocked = 0, inherited = 0;
  for (const std::string& oracle : kOracles)
    for (const bool multigrid : {false, true}) {
      const Scene scene = FurnishedRoom(random, 3);
      const PatchVisibility visibility(scene);
      SolverOptions options;
      options.eps = 1;
      options.min_area = 0.02;
      options.oracle = oracle;
      options.multigrid = multigrid;
      HierarchicalSolver solver(scene, visibility, options);
      const RadiositySolution& solution = solver.solution();
      const ElementForest& forest = solution.forest;
      while (!solver.Converged()) {
        const BlockersOfLinks before = AllBlockers(solution.links);
        ASSERT_TRUE(solver.Iterate(ExecutionContext())) << oracle;
        SCOPED_TRACE(oracle);
        ExpectInherited(solution, before);
        inherited += solution.links.links.size();
      }
      std::map<Pair, const Link*> links;
      for (const Link& link : solution.links.links) links[{link.receiver, link.source}] = &link;
      const std::vector<ElementId> leaves = forest.AllLeaves();
      for (int i = 0; i < 3000; ++i) {
        const ElementId a = leaves[random.Index(static_cast<std::uint32_t>(leaves.size()))];
        const ElementId b = leaves[random.Index(static_cast<std::uint32_t>(leaves.size()))];
        const Link* found = nullptr;
        int count = 0;
        for (ElementId r = a; r != kNoElement; r = forest[r].parent)
          for (ElementId s = b; s != kNoElement; s = forest[s].parent)
            if (const auto link = links.find({r, s}); link != links.end()) {
              found = link->second;
              ++count;
            }
        EXPECT_LE(count, 1) << oracle;
        const Vec3 p = PointIn(random, forest[a]), q = PointIn(random, forest[b]);
        const bool facing = scene.patches[forest[a].patch].normal.dot(q - p) > 1e-9 &&
                            scene.patches[forest[b].patch].normal.dot(p - q) > 1e-9;
        if (!facing) continue;
        const std::vector<PatchId> between = Crossed(scene, p, q);
        if (between.empty()) {
          EXPECT_EQ(count, 1) << oracle;
          ++pairs;
        }
        if (!found) continue;
        for (const PatchId blocker : between) {
          EXPECT_TRUE(std::ranges::binary_search(solution.links.Blockers(*found), blocker)) << oracle;
          ++blocked;
        }
      }
    }
  std::printf("seed 3001: %zu pairs that see each other, %zu blockers met, %zu links with ancestors\n", pairs,
              blocked, inherited);
  EXPECT_GT(pairs, 2000U);
  EXPECT_GT(blocked, 500U);
}

// Whatever the oracle, the light is the same: patches' mean irradiance, corrected, within 2 % of the
// brightest patch's from that of a much finer solution; and a smaller eps has more links.
TEST(Refinement, OraclesAgreeAboutTheLight) {
  Random random(3002);
  const Scene scene = FurnishedRoom(random, 2);
  const PatchVisibility visibility(scene);
  const auto solved = [&](const std::string& oracle, double eps, bool multigrid) {
    SolverOptions options;
    options.eps = eps;
    options.min_area = 0.004;
    options.oracle = oracle;
    options.multigrid = multigrid;
    HierarchicalSolver solver(scene, visibility, options);
    solver.Solve(ExecutionContext());
    EXPECT_TRUE(solver.Converged());
    RadiositySolution solution = solver.solution();
    return solution;
  };
  const RadiositySolution fine = solved("transport", 0.02, false);
  double largest = 0;
  for (std::size_t p = 0; p < scene.patches.size(); ++p)
    largest = std::max(largest, fine.irradiance[p].maxCoeff());
  for (const std::string& oracle : kOracles)
    for (const bool multigrid : {false, true}) {
      if (multigrid && oracle != "transport") continue;
      const double eps = 0.04;
      const RadiositySolution coarse = solved(oracle, 4 * eps, multigrid);
      const RadiositySolution solution = solved(oracle, eps, multigrid);
      double worst = 0;
      for (std::size_t p = 0; p < scene.patches.size(); ++p)
        worst = std::max(worst, (solution.irradiance[p] - fine.irradiance[p]).abs().maxCoeff());
      std::printf("%-10s %s: %zu links, at 4 eps %zu, off by %.2g of the largest, energy by %.2g\n",
                  oracle.c_str(), multigrid ? "multigrid" : "at once  ", solution.links.links.size(),
                  coarse.links.links.size(), worst / largest, MeasureEnergy(solution).relative_imbalance);
      EXPECT_LE(worst, 0.02 * largest) << oracle;
      EXPECT_GT(solution.links.links.size(), coarse.links.links.size()) << oracle;
    }
}

}  // namespace
}  // namespace penumbra::scene_test
