#include "solver/transport/oracle.h"

#include <cmath>

namespace penumbra {
namespace {

// What a receiver's irradiance deviates by averages out over the receiver; what a source's uneven radiosity
// brings does not: near bright parts of a wall receivers are bright, so that it errs to the dark side on
// every link and adds up to some hundredths of missing energy. Deferred correction takes most of that away;
// this share of eps leaves it little to do. (Without it, 0.004 balances the energy of closed boxes to 1e-3,
// with five times the links.)
constexpr double kSourceShare = 0.3;

}  // namespace

Refinement TransportOracle::Judge(const RadiositySolution& solution, const Link& link) const {
  const Element& receiver = solution.forest[link.receiver];
  const double weight = std::sqrt(receiver.area / reference_area_);
  const double receiver_error = weight * solution.radiosity[link.source].maxCoeff() * link.variation;
  // The shares of the quarters carry the source's own unevenness: what is left is that of its children, whose
  // form factor varies half as much.
  const double source_error =
      weight * 0.5 * link.source_variation * link.form_factor * solution.spread_below[link.source];
  const bool receiver_may = receiver.area >= 4 * min_area_ && receiver.level < kMaxLevel;
  const bool source_may = !solution.forest[link.source].IsLeaf();
  const bool split_receiver = receiver_may && receiver_error > eps_;
  const bool split_source = source_may && source_error > kSourceShare * eps_;
  if (split_receiver && (!split_source || receiver_error >= source_error)) return Refinement::kSplitReceiver;
  return split_source ? Refinement::kSplitSource : Refinement::kAccept;
}

}  // namespace penumbra
