#include "mesh/discontinuities/random_choice.h"

#include "solver/base/random.h"

namespace penumbra {
namespace {

class RandomChoice final : public DiscontinuityChoiceMethod {
 public:
  std::optional<DiscontinuityRanks> Rank(PatchId patch, std::span<const Discontinuity> found,
                                         const DiscontinuityOptions& options) const override {
    DiscontinuityRanks ranks;
    ranks.least = 1 - options.random_share;
    Random random(options.seed, static_cast<std::uint64_t>(patch));
    for (const Discontinuity& d : found) {
      const double place = random.Uniform();
      ranks.rank.push_back(d.kind == DiscontinuityKind::kContact ? kInfiniteWeight : place);
    }
    return ranks;
  }
};

}  // namespace

DiscontinuityChoiceRegistry::Method RandomChoiceMethod() {
  return {"random", "any in random order, as many as a leaf may have", {}, [] {
            return std::make_unique<const RandomChoice>();
          }};
}

}  // namespace penumbra
