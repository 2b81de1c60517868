// display/viewer/comparison.h
//
// Two states side by side under a slider, from one camera, at one exposure.

#pragma once

#include <memory>
#include <optional>
#include <string>

#include "display/viewer/picture.h"
#include "display/viewer/snapshot.h"
#include "display/viewer/view_state.h"

namespace penumbra::viewer {

// How much two pictures differ: percentiles of |a - b| / max(b, 1 % of the mean of b) over the pixels that
// show a surface in both, of the mean of the channels.
struct PictureDifference {
  double p50 = 0, p95 = 0, p99 = 0;
  std::size_t pixels = 0;
};

class Comparison {
 public:
  // Keeps a state, to compare others with it.
  void Keep(std::shared_ptr<const Snapshot> state) { kept_ = std::move(state); }
  bool HasKept() const { return kept_ != nullptr; }

  // Draws the kept state left of the fraction `at` of the width, and `now` right of it. `view` and `now` must
  // be those of the last picture that `now` has made. REQUIRES: HasKept().
  const Srgb8Image& Draw(const PictureMaker& now, const ViewState& view, double at);
  // Of the last drawing.
  const PictureDifference& difference() const { return difference_; }

 private:
  std::shared_ptr<const Snapshot> kept_;
  PictureMaker picture_;
  Srgb8Image screen_;
  PictureDifference difference_;
};

// `now` against `kept`, at every kDifferenceStride-th pixel of every kDifferenceStride-th row.
PictureDifference Difference(const RenderedFrame& now, const RenderedFrame& kept);
inline constexpr int kDifferenceStride = 3;

// One line of text about a difference.
std::string TextOf(const PictureDifference& difference);

}  // namespace penumbra::viewer
