#include "solver/transport/solvers/settling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/transport/solvers/anderson.h"

namespace penumbra {
namespace {

// The largest number of sweeps: without acceleration, rooms of reflectance 0.99 need about 1,400.
constexpr std::size_t kMaxSweeps = 5000;

// Settling ends after this number of sweeps without a smaller residual: what remains is rounding, or light
// that grows on the links without limit.
constexpr std::size_t kStagnant = 100;

// The largest number of terms in the bound's partial sum. The sum ends if another term lowers the bound to no
// less than kWorthAnotherTerm of its value.
constexpr int kMostTerms = 200;
constexpr double kWorthAnotherTerm = 0.9;

double Residual(const Rgb& change, const Rgb& to_come, const PushPull& push_pull) {
  double missing = 0;
  for (int c = 0; c < 3; ++c)
    if (change[c] > 0) missing = std::max(missing, change[c] * to_come[c]);
  const double largest = push_pull.LargestReflected();
  return largest > 0 ? missing / largest : 0;
}

}  // namespace

Rgb LightToCome(const PushPull& push_pull, const RadiositySolution& solution,
                const ExecutionContext& context) {
  const ElementForest& forest = solution.forest;
  std::vector<Rgb> term(forest.size(), Rgb::Ones()), sum(forest.size(), Rgb::Zero());
  Rgb bound = Rgb::Constant(INFINITY);
  for (int m = 0; m < kMostTerms && !context.Cancelled(); ++m) {
    std::vector<Rgb> next = push_pull.Transport(term);
    for (std::size_t e = 0; e < next.size(); ++e)
      next[e] *= forest.scene().MaterialOf(forest.elements()[e].patch).reflectance;
    Rgb growth = Rgb::Zero();
    for (const ElementId leaf : push_pull.leaves())
      for (int c = 0; c < 3; ++c)
        if (next[leaf][c] > 0) growth[c] = std::max(growth[c], next[leaf][c] / term[leaf][c]);
    // The terms after this one fall at least by the factor `growth` everywhere.
    Rgb now = Rgb::Zero();
    for (const ElementId leaf : push_pull.leaves())
      for (int c = 0; c < 3; ++c)
        if (next[leaf][c] > 0)
          now[c] =
              std::max(now[c], growth[c] < 1 ? sum[leaf][c] + next[leaf][c] / (1 - growth[c]) : INFINITY);
    const bool enough = now.isFinite().all() && (now >= kWorthAnotherTerm * bound).all();
    bound = bound.min(now);
    if (enough) break;
    for (std::size_t e = 0; e < next.size(); ++e) sum[e] += next[e];
    term = std::move(next);
  }
  return bound;
}

Settled Settle(PushPull& push_pull, RadiositySolution& solution, std::span<const Rgb> correction,
               const SettlingOptions& options, const ExecutionContext& context) {
  const Rgb to_come = LightToCome(push_pull, solution, context);
  const std::span<const ElementId> leaves = push_pull.leaves();
  std::vector<double> area;
  for (const ElementId leaf : leaves) area.push_back(solution.forest[leaf].area);
  AndersonAcceleration anderson(std::move(area));
  const auto light_of_leaves = [&] {
    std::vector<Rgb> light;
    light.reserve(leaves.size());
    for (const ElementId leaf : leaves) light.push_back(solution.irradiance[leaf]);
    return light;
  };
  Settled settled;
  double nearest = INFINITY;
  std::size_t stagnant = 0;
  settled.to_come = to_come.maxCoeff();
  const std::size_t most = options.most_sweeps > 0 ? options.most_sweeps : kMaxSweeps;
  while (settled.sweeps < most && !context.Cancelled()) {
    const std::vector<Rgb> before = light_of_leaves();
    settled.residual = Residual(push_pull.Sweep(options.scheme, correction), to_come, push_pull);
    ++settled.sweeps;
    // The change of a sweep bounds the remaining error from any starting point, so guesses may be bad.
    if (settled.residual <= options.cutoff) break;
    stagnant = settled.residual < nearest ? 0 : stagnant + 1;
    nearest = std::min(nearest, settled.residual);
    if (stagnant == kStagnant) break;
    // The last step is a sweep, not a guess.
    if (options.acceleration == Acceleration::kNone || settled.sweeps == most) continue;
    std::vector<Rgb> guess = light_of_leaves();
    anderson.Improve(before, guess);
    for (std::size_t i = 0; i < leaves.size(); ++i) push_pull.Light(leaves[i], guess[i]);
    push_pull.Pull();
  }
  push_pull.UpdateSpreads();
  return settled;
}

}  // namespace penumbra
