#include "mesh/discontinuities/all_choice.h"

#include <limits>

namespace penumbra {
namespace {

class AllChoice final : public DiscontinuityChoiceMethod {
 public:
  std::size_t MostLines(const DiscontinuityOptions&) const override {
    return std::numeric_limits<std::size_t>::max();
  }

  std::optional<DiscontinuityRanks> Rank(PatchId, std::span<const Discontinuity> found,
                                         const DiscontinuityOptions&) const override {
    DiscontinuityRanks ranks;
    for (const Discontinuity& d : found) ranks.rank.push_back(d.weight);
    return ranks;
  }
};

}  // namespace

DiscontinuityChoiceRegistry::Method AllChoiceMethod() {
  return {
      "all", "all of them, however many a leaf gets", {}, [] { return std::make_unique<const AllChoice>(); }};
}

}  // namespace penumbra
