// display/image_difference.h
//
// How far a picture is from another: in numbers, and to an eye.

#pragma once

#include <array>
#include <vector>

#include "display/image.h"
#include "solver/base/progress.h"

namespace penumbra {

// The relative error of a channel, |test - reference| / max(reference, kDarkest of the channel's mean).
struct ChannelError {
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  double mean_ratio = 1;  // of the means, test over reference; 1 if both are 0
};
inline constexpr double kDarkest = 0.01;

// Per channel. REQUIRES: equal sizes, a pixel or more, finite values.
std::array<ChannelError, 3> RelativeErrors(const RgbImage& reference, const RgbImage& test);

// How far the screen is away: a screen 0.7 m wide of 3840 pixels at a distance of 0.7 m, as Andersson et al.
// have it.
inline constexpr double kPixelsPerDegree = 67.0206;

// The visible difference of two pictures on a screen, 0 (none) to 1 per pixel: FLIP (Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, sections 4 and 5). Both are exposed, linear, in [0,
// 1]. Symmetric. REQUIRES: equal sizes.
std::vector<float> FlipOfExposed(const RgbImage& a, const RgbImage& b,
                                 double pixels_per_degree = kPixelsPerDegree);

struct VisibleDifference {
  std::vector<float> map;  // per pixel, rows from the top: the largest over the exposures
  double mean = 0, max = 0;
  // The exposures that were looked at, factors on the pictures' values, a stop apart or less.
  std::vector<double> exposures;
};

// The same of pictures of any range, after HDR-FLIP (Andersson, Nilsson, Shirley and Akenine-Moeller 2021):
// at exposures from that which shows the brightest pixel of the reference just below white to that which
// shows the median one so, each cut off at white as our display does.
// Cancelled, it is of no use.
VisibleDifference FindVisibleDifference(const RgbImage& reference, const RgbImage& test,
                                        double pixels_per_degree = kPixelsPerDegree,
                                        const ExecutionContext& context = {});

}  // namespace penumbra
