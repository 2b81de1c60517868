#include "mesh/discontinuities/discontinuity_choices.h"

#include "mesh/discontinuities/adaptive_choice.h"
#include "mesh/discontinuities/all_choice.h"
#include "mesh/discontinuities/none_choice.h"
#include "mesh/discontinuities/random_choice.h"
#include "mesh/discontinuities/ranked_choice.h"

namespace penumbra {

DiscontinuityChoiceRegistry& DiscontinuityChoices() {
  static DiscontinuityChoiceRegistry registry(
      "choice of discontinuities", {RankedChoiceMethod(), AdaptiveChoiceMethod(), NoneChoiceMethod(),
                                    RandomChoiceMethod(), AllChoiceMethod()});
  return registry;
}

}  // namespace penumbra
