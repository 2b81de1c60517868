// display/viewer/session_progress.h
//
// How far a chain of tasks is. The phases of a solve take turns: light is refined in several turns of the
// same phases. A bar that runs from 0 to 1 in each of them would say nothing; this class makes one number of
// them, which never falls.

#pragma once

#include <string>
#include <string_view>

namespace penumbra::viewer {

// The stages of a solve, in their order.
enum class SolveStage { kLoad, kLink, kIterate, kCorrect, kLight, kMesh, kOperator, kMeasure, kOther };
std::string_view NameOf(SolveStage stage);

class SessionProgress {
 public:
  // Begins a stage. A chain of tasks begins again with a stage before the present one.
  void Begin(SolveStage stage);
  // A phase of the stage has reached `fraction`. A phase that starts once more begins another turn.
  void Report(std::string_view phase, double fraction);

  SolveStage stage() const { return stage_; }
  int turn() const { return turn_; }
  // The fraction that is done, in [0, 1): each stage has a part of the whole, of which each phase takes a
  // part of what is left, for the number of turns is not known.
  double fraction() const { return fraction_; }

 private:
  SolveStage stage_ = SolveStage::kOther;
  std::string phase_;
  double phase_fraction_ = 0;
  int turn_ = 0, phases_ = 0;
  double fraction_ = 0;
};

}  // namespace penumbra::viewer
