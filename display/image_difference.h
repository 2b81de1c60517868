// display/image_difference.h
//
// The difference of two pictures: relative errors, and the visible difference.

#pragma once

#include <array>
#include <vector>

#include "display/image.h"
#include "solver/base/progress.h"

namespace penumbra {

// Statistics of the relative error |test - reference| / max(reference, kDarkest * mean of reference) over the
// pixels of one channel.
struct ChannelError {
  double max = 0, p99 = 0, p95 = 0, rms = 0;
  double mean_ratio = 1;  // mean of test / mean of reference; 1 if both are 0
};
inline constexpr double kDarkest = 0.01;

// The errors of each channel. REQUIRES: the pictures have equal sizes, at least one pixel, and finite values.
std::array<ChannelError, 3> RelativeErrors(const RgbImage& reference, const RgbImage& test);

// The number of pixels per degree of the field of view, for a screen of 3840 pixels and 0.7 m width at a
// distance of 0.7 m, as in Andersson et al.
inline constexpr double kPixelsPerDegree = 67.0206;

// The visible difference of two pictures on a screen, a value from 0 (no difference) to 1 for each pixel:
// FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, sections 4 and 5). Both
// pictures are exposed and have linear values in [0, 1]. The result is symmetric in a and b. REQUIRES: the
// pictures have equal sizes.
std::vector<float> FlipOfExposed(const RgbImage& a, const RgbImage& b,
                                 double pixels_per_degree = kPixelsPerDegree);

struct VisibleDifference {
  std::vector<float> map;  // per pixel, rows from the top: the maximum over the exposures
  double mean = 0, max = 0;
  // The exposures that were used: factors by which the pictures' values are multiplied. Successive factors
  // differ by at most one stop, a factor of 2.
  std::vector<double> exposures;
};

// The visible difference of pictures of any range, after HDR-FLIP (Andersson, Nilsson, Shirley and
// Akenine-Moeller 2021). With the lowest exposure, the brightest pixel of the reference is just below white;
// with the highest exposure, the median pixel is just below white. Each exposed picture is clipped at white,
// as on the display. If the context is cancelled, the result is unspecified.
VisibleDifference FindVisibleDifference(const RgbImage& reference, const RgbImage& test,
                                        double pixels_per_degree = kPixelsPerDegree,
                                        const ExecutionContext& context = {});

}  // namespace penumbra
