#include "solver/transport/oracle.h"

namespace penumbra {

Refinement TransportOracle::Judge(const RadiositySolution& solution, const Link& link) const {
  const Element& receiver = solution.forest[link.receiver];
  const double receiver_error = solution.radiosity[link.source].maxCoeff() * link.variation;
  const double source_error = solution.radiosity_spread[link.source] * link.form_factor;
  const bool receiver_may = receiver.area >= 4 * min_area_ && receiver.level < kMaxLevel;
  const bool source_may = !solution.forest[link.source].IsLeaf();
  const bool split_receiver = receiver_may && receiver_error > eps_;
  const bool split_source = source_may && source_error > eps_;
  if (split_receiver && (!split_source || receiver_error >= source_error)) return Refinement::kSplitReceiver;
  return split_source ? Refinement::kSplitSource : Refinement::kAccept;
}

}  // namespace penumbra
