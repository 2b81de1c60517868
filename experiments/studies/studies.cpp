#include "experiments/studies/study.h"

namespace penumbra {

extern const Study kPointIrradianceStudy;
extern const Study kOffsetStudy;
extern const Study kFormFactorStudy;

const std::vector<const Study*>& Studies() {
  static const std::vector<const Study*> studies = {&kPointIrradianceStudy, &kOffsetStudy, &kFormFactorStudy};
  return studies;
}

}  // namespace penumbra
