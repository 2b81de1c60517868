#include "experiments/studies/study.h"

namespace penumbra {

extern const Study kPointIrradianceStudy;
extern const Study kOffsetStudy;
extern const Study kFormFactorStudy;
extern const Study kHierarchicalStudy;
extern const Study kContinuousRadiosityStudy;
extern const Study kDiscontinuityStudy;
extern const Study kContactCornerStudy;
extern const Study kInterpolantOrderStudy;
extern const Study kRefinementStudy;
extern const Study kErrorLadderStudy;
extern const Study kRandomRoomStudy;
extern const Study kDisplayStudy;
extern const Study kWholeSystemStudy;
extern const Study kStabilityStudy;
extern const Study kGrowthStudy;
extern const Study kMethodsStudy;
extern const Study kReconstructionStudy;

const std::vector<const Study*>& Studies() {
  static const std::vector<const Study*> studies = {
      &kPointIrradianceStudy,      // 6.2
      &kOffsetStudy,               // 6.3
      &kFormFactorStudy,           // 4.2
      &kHierarchicalStudy,         // 4.4.1
      &kContinuousRadiosityStudy,  // 4, against what is known exactly
      &kDiscontinuityStudy,        // 5
      &kContactCornerStudy,        // 5, where edges end
      &kInterpolantOrderStudy,     // 3.2, 3.3
      &kRefinementStudy,           // 4.4.2
      &kErrorLadderStudy,          // 4.4.2, what a user is promised
      &kRandomRoomStudy,           // the same, in any room
      &kDisplayStudy,              // 7.2, figure 7-4
      &kWholeSystemStudy,          // 7
      &kStabilityStudy,            // what can go wrong
      &kGrowthStudy,               // what bounds large scenes
      &kMethodsStudy,              // the methods of the field, side by side
      &kReconstructionStudy,       // what shows the light of elements
  };
  return studies;
}

}  // namespace penumbra
