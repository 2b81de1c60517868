#include "display/image_difference.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "display/flip.h"
#include "display/tone_mapping.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr double kBelowWhite = 0.85;  // of the range of the screen (HDR-FLIP, section 3.2)
constexpr int kMostExposures = 40;    // a factor of 1e12 between the brightest and the median

double Mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += static_cast<double>(value);
  return sum / static_cast<double>(values.size());
}

// The value that the share of all values does not exceed. Reorders them.
double Percentile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  const auto at = values.begin() + std::max<std::ptrdiff_t>(0, rank);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::vector<double> Exposures(const RgbImage& reference) {
  std::vector<double> luminance;
  for (std::size_t i = 0; i < reference.PixelCount(); ++i) {
    const double y = Luminance({reference.channel[0][i], reference.channel[1][i], reference.channel[2][i]});
    if (y > 0) luminance.push_back(y);
  }
  if (luminance.empty()) return {1};
  const double brightest = *std::max_element(luminance.begin(), luminance.end());
  const double first = std::log2(kBelowWhite / brightest),
               last = std::log2(kBelowWhite / Percentile(luminance, 0.5));
  const int count = std::clamp(static_cast<int>(std::ceil(last - first)), 2, kMostExposures);
  std::vector<double> exposures;
  for (int i = 0; i < count; ++i) exposures.push_back(std::exp2(first + (last - first) * i / (count - 1)));
  return exposures;
}

RgbImage ExposeAndCut(const RgbImage& image, double exposure) {
  RgbImage exposed(image.width, image.height);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < image.PixelCount(); ++i)
      exposed.channel[c][i] =
          static_cast<float>(std::clamp(exposure * static_cast<double>(image.channel[c][i]), 0.0, 1.0));
  return exposed;
}

}  // namespace

std::array<ChannelError, 3> RelativeErrors(const RgbImage& reference, const RgbImage& test) {
  PENUMBRA_CHECK(reference.width == test.width && reference.height == test.height &&
                 reference.PixelCount() > 0);
  std::array<ChannelError, 3> errors;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<float>&truth = reference.channel[c], &shown = test.channel[c];
    const double mean = Mean(truth), shown_mean = Mean(shown);
    std::vector<double> relative(truth.size());
    double squares = 0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      const double want = static_cast<double>(truth[i]);
      const double off = std::abs(static_cast<double>(shown[i]) - want),
                   scale = std::max(want, kDarkest * mean);
      // Against darkness, whatever shines is infinitely far off.
      relative[i] = off == 0 ? 0 : scale > 0 ? off / scale : INFINITY;
      squares += relative[i] * relative[i];
    }
    errors[c].max = *std::max_element(relative.begin(), relative.end());
    errors[c].p99 = Percentile(relative, 0.99);
    errors[c].p95 = Percentile(relative, 0.95);
    errors[c].rms = std::sqrt(squares / static_cast<double>(truth.size()));
    errors[c].mean_ratio = mean == shown_mean ? 1 : shown_mean / mean;
  }
  return errors;
}

VisibleDifference FindVisibleDifference(const RgbImage& reference, const RgbImage& test,
                                        double pixels_per_degree, const ExecutionContext& context) {
  VisibleDifference difference;
  difference.exposures = Exposures(reference);
  difference.map.assign(reference.PixelCount(), 0.0F);
  std::size_t compared = 0;
  for (const double exposure : difference.exposures) {
    if (context.Cancelled()) break;
    const std::vector<float> map =
        FlipOfExposed(ExposeAndCut(reference, exposure), ExposeAndCut(test, exposure), pixels_per_degree);
    for (std::size_t i = 0; i < map.size(); ++i) difference.map[i] = std::max(difference.map[i], map[i]);
    context.Report("compare",
                   static_cast<double>(++compared) / static_cast<double>(difference.exposures.size()));
  }
  difference.mean = Mean(difference.map);
  difference.max = static_cast<double>(*std::max_element(difference.map.begin(), difference.map.end()));
  return difference;
}

}  // namespace penumbra
