// display/image_difference.h
//
// The difference of two pictures: relative errors, and the visible difference.

#pragma once

#include <array>
#include <vector>

#include "display/image.h"
#include "solver/base/progress.h"

namespace penumbra {

// Statistics of the relative error of a channel, |test - reference| / max(reference, kDarkest * mean of the
// reference's channel).
struct ChannelError {
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  double mean_ratio = 1;  // mean of test / mean of reference; 1 if both are 0
};
inline constexpr double kDarkest = 0.01;

// The errors of each channel. REQUIRES: equal sizes, at least one pixel, finite values.
std::array<ChannelError, 3> RelativeErrors(const RgbImage& reference, const RgbImage& test);

// Pixels per degree of the view, for a screen of 3840 pixels and 0.7 m width at a distance of 0.7 m, as in
// Andersson et al.
inline constexpr double kPixelsPerDegree = 67.0206;

// The visible difference of two pictures on a screen, 0 (none) to 1 per pixel: FLIP (Andersson, Nilsson,
// Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, sections 4 and 5). Both pictures are exposed,
// linear, in [0, 1]. The result is symmetric in a and b. REQUIRES: equal sizes.
std::vector<float> FlipOfExposed(const RgbImage& a, const RgbImage& b,
                                 double pixels_per_degree = kPixelsPerDegree);

struct VisibleDifference {
  std::vector<float> map;  // per pixel, rows from the top: the maximum over the exposures
  double mean = 0, max = 0;
  // The exposures that were compared: factors of the pictures' values, at most one stop apart.
  std::vector<double> exposures;
};

// The visible difference of pictures of any range, after HDR-FLIP (Andersson, Nilsson, Shirley and
// Akenine-Moeller 2021). The exposures range from the one that shows the brightest pixel of the reference
// just below white to the one that does so for the median pixel. Each exposed picture is clipped at white, as
// the display does. If the context is cancelled, the result is unspecified.
VisibleDifference FindVisibleDifference(const RgbImage& reference, const RgbImage& test,
                                        double pixels_per_degree = kPixelsPerDegree,
                                        const ExecutionContext& context = {});

}  // namespace penumbra
