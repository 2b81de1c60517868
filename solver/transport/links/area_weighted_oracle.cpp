#include "solver/transport/links/area_weighted_oracle.h"

#include <cmath>

namespace penumbra {
namespace {

// Errors of irradiance that vary over a receiver average out. Errors from the uneven radiosity of a source do
// not: near bright parts of a wall receivers are bright, so every link is too dark, and a few hundredths of
// the energy are missing. Deferred correction removes most of this error; with this fraction of eps for it,
// little remains to correct. (Without correction, a fraction of 0.004 balances the energy of closed boxes to
// 1e-3, with five times as many links.)
constexpr double kSourceShare = 0.3;

}  // namespace

Refinement AreaWeightedOracle::Judge(const RadiositySolution& solution, const Link& link) const {
  const Element& receiver = solution.forest[link.receiver];
  const double weight = std::sqrt(receiver.area / options_.reference_area);
  const double receiver_error =
      weight * solution.radiosity[link.source].maxCoeff() * Deviation(solution.forest, link);
  // The shares of the quarters account for the variation between the children's radiosities. What remains
  // varies within the children, over which the form factor varies half as much.
  const double source_error =
      weight * 0.5 * link.source_variation * link.form_factor * solution.spread_below[link.source];
  // Only a source with children is split: its light has no more detail than its tree.
  const bool source_may = !solution.forest[link.source].IsLeaf();
  const bool split_receiver = MaySplit(receiver, options_.min_area) && receiver_error > options_.eps;
  const bool split_source = source_may && source_error > kSourceShare * options_.eps;
  if (split_receiver && (!split_source || receiver_error >= source_error)) return Refinement::kSplitReceiver;
  return split_source ? Refinement::kSplitSource : Refinement::kAccept;
}

}  // namespace penumbra
