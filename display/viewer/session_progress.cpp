#include "display/viewer/session_progress.h"

#include <algorithm>
#include <cmath>

namespace penumbra::viewer {
namespace {

struct StagePart {
  std::string_view name;
  double begin, end;           // of the whole
  std::string_view turn = {};  // the phase that begins each turn; empty: the stage has none
};

// The shares of the stages in the seconds of a solve of the office, rounded.
constexpr StagePart kParts[] = {{"load", 0, 0.02},
                                {"link", 0.02, 0.15},
                                {"iterate", 0.15, 0.35},
                                {"correct", 0.35, 0.4},
                                {"refine light", 0.4, 0.7, "refine sources"},
                                {"refine the mesh", 0.7, 0.9, "discontinuities"},
                                {"keep transport", 0, 0.9},
                                {"measure", 0.9, 0.99},
                                {"", 0, 0.99}};

// Each phase takes this part of what is left of its stage.
constexpr double kOfRest = 0.3;

const StagePart& PartOf(SolveStage stage) { return kParts[static_cast<std::size_t>(stage)]; }

}  // namespace

std::string_view NameOf(SolveStage stage) { return PartOf(stage).name; }

void SessionProgress::Begin(SolveStage stage) {
  const bool onward = PartOf(stage).begin >= PartOf(stage_).begin && stage_ != SolveStage::kOther &&
                      stage != SolveStage::kOther && stage != SolveStage::kOperator;
  stage_ = stage;
  phase_.clear();
  phase_fraction_ = 0;
  turn_ = phases_ = 0;
  fraction_ = onward ? std::max(fraction_, PartOf(stage).begin) : PartOf(stage).begin;
}

void SessionProgress::Report(std::string_view phase, double fraction) {
  const bool again = phase == phase_ && fraction < phase_fraction_;
  if (phase != phase_ || again) {
    if (!phase_.empty()) ++phases_;
    if (phase == PartOf(stage_).turn) ++turn_;
  }
  phase_ = phase;
  phase_fraction_ = fraction;
  const StagePart& part = PartOf(stage_);
  const double left = std::pow(1 - kOfRest, phases_) * (1 - kOfRest * std::clamp(fraction, 0.0, 1.0));
  fraction_ = std::max(fraction_, part.end - (part.end - part.begin) * left);
}

}  // namespace penumbra::viewer
