#include "experiments/studies/study.h"

namespace penumbra {

extern const Study kPointIrradianceStudy;
extern const Study kOffsetStudy;
extern const Study kFormFactorStudy;
extern const Study kWholeSystemStudy;
extern const Study kStabilityStudy;
extern const Study kContinuousRadiosityStudy;
extern const Study kDiscontinuityStudy;

const std::vector<const Study*>& Studies() {
  static const std::vector<const Study*> studies = {&kPointIrradianceStudy, &kOffsetStudy,
                                                    &kFormFactorStudy,      &kWholeSystemStudy,
                                                    &kStabilityStudy,       &kContinuousRadiosityStudy,
                                                    &kDiscontinuityStudy};
  return studies;
}

}  // namespace penumbra
