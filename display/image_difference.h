// display/image_difference.h
//
// The difference of two pictures: relative errors per channel, and the visible difference (FLIP).

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

// The relative errors of each channel of a picture. REQUIRES: the pictures have equal sizes, at least one
// pixel, and finite values.
std::array<ChannelError, 3> RelativeErrors(const RgbImage& reference, const RgbImage& test);

// The number of pixels per degree of the field of view, for a screen that is 3840 pixels and 0.7 m wide, at a
// distance of 0.7 m (Andersson et al. 2020).
inline constexpr double kPixelsPerDegree = 67.0206;

// The visible difference of two pictures on a screen, a value from 0 (no difference) to 1 for each pixel:
// FLIP (Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem and Fairchild 2020, sections 4 and 5). Both
// pictures must be exposed, with linear values in [0, 1]. FlipOfExposed(a, b) equals FlipOfExposed(b, a).
// REQUIRES: the pictures have equal sizes.
std::vector<float> FlipOfExposed(const RgbImage& a, const RgbImage& b,
                                 double pixels_per_degree = kPixelsPerDegree);

struct VisibleDifference {
  // the visible difference of each pixel, rows from the top: the maximum over all exposures
  std::vector<float> map;
  double mean = 0, max = 0;
  // The exposures at which the pictures were compared: factors by which the pictures' values are multiplied.
  // Successive exposures differ by at most one stop, a factor of 2.
  std::vector<double> exposures;
};

// The visible difference of pictures of any range, after HDR-FLIP (Andersson, Nilsson, Shirley and
// Akenine-Moeller 2021). With the lowest exposure, the brightest pixel of the reference is just below white;
// with the highest exposure, the median pixel is just below white. Each exposed picture is clipped at white,
// as on a screen. If the computation is cancelled (ExecutionContext), the VisibleDifference is unspecified.
VisibleDifference FindVisibleDifference(const RgbImage& reference, const RgbImage& test,
                                        double pixels_per_degree = kPixelsPerDegree,
                                        const ExecutionContext& context = {});

}  // namespace penumbra
