#include "solver/transport/links/area_weighted_oracle.h"

#include <cmath>

namespace penumbra {
namespace {

// The deviation of irradiance over a receiver averages out over the receiver. The error from a source's
// uneven radiosity does not: near bright parts of a wall receivers are bright, so that every link errs to the
// dark side, and some hundredths of the energy go missing. Deferred correction takes most of that away; this
// share of eps leaves it little to do. (Without it, 0.004 balances the energy of closed boxes to 1e-3, with
// five times the links.)
constexpr double kSourceShare = 0.3;

}  // namespace

Refinement AreaWeightedOracle::Judge(const RadiositySolution& solution, const Link& link) const {
  const Element& receiver = solution.forest[link.receiver];
  const double weight = std::sqrt(receiver.area / options_.reference_area);
  const double receiver_error =
      weight * solution.radiosity[link.source].maxCoeff() * Deviation(solution.forest, link);
  // The shares of the quarters carry the source's own unevenness: what is left is that of its children,
  // whose form factor varies half as much.
  const double source_error =
      weight * 0.5 * link.source_variation * link.form_factor * solution.spread_below[link.source];
  // A source is split only where it has children: its light is no more detailed than its tree.
  const bool source_may = !solution.forest[link.source].IsLeaf();
  const bool split_receiver = MaySplit(receiver, options_.min_area) && receiver_error > options_.eps;
  const bool split_source = source_may && source_error > kSourceShare * options_.eps;
  if (split_receiver && (!split_source || receiver_error >= source_error)) return Refinement::kSplitReceiver;
  return split_source ? Refinement::kSplitSource : Refinement::kAccept;
}

}  // namespace penumbra
