#include "display/viewer/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "solver/base/check.h"

namespace penumbra::viewer {
namespace {

// The mean of the channels of a pixel.
double MeanAt(const RgbImage& image, std::size_t i) {
  return static_cast<double>(image.channel[0][i] + image.channel[1][i] + image.channel[2][i]) / 3;
}

double Percentile(std::vector<double>& values, double fraction) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

PictureDifference Difference(const RenderedFrame& now, const RenderedFrame& kept) {
  PictureDifference difference;
  if (now.width != kept.width || now.height != kept.height) return difference;
  constexpr double kFloor = 0.01;  // of the mean: what is nearly black differs by little that is seen
  double mean = 0;
  std::vector<std::size_t> shared;
  for (int y = 0; y < now.height; y += kDifferenceStride)
    for (int x = 0; x < now.width; x += kDifferenceStride) {
      const std::size_t i = now.linear.Index(x, y);
      if (now.kind[i] != PixelKind::kSurface || kept.kind[i] != PixelKind::kSurface) continue;
      shared.push_back(i);
      mean += MeanAt(kept.linear, i);
    }
  difference.pixels = shared.size();
  if (shared.empty() || !(mean > 0)) return difference;
  mean /= static_cast<double>(shared.size());
  std::vector<double> errors;
  for (const std::size_t i : shared) {
    const double a = MeanAt(now.linear, i), b = MeanAt(kept.linear, i);
    errors.push_back(std::abs(a - b) / std::max(b, kFloor * mean));
  }
  difference.p50 = Percentile(errors, 0.5);
  difference.p95 = Percentile(errors, 0.95);
  difference.p99 = Percentile(errors, 0.99);
  return difference;
}

std::string TextOf(const PictureDifference& difference) {
  return fmt::format("differs by {:.3g} (median), {:.3g} (95 %), {:.3g} (99 %) of what was kept",
                     difference.p50, difference.p95, difference.p99);
}

const Srgb8Image& Comparison::Draw(const PictureMaker& now, const ViewState& view, double at) {
  PENUMBRA_CHECK(kept_ != nullptr);
  const Srgb8Image& right = now.screen();
  ViewState same = view;
  same.auto_exposure = false;
  same.exposure = now.exposure();
  if (now.scale() != ColourScale::kNone) same.false_colour_max = now.scale_top();
  same.error_map = false;  // its values are of another mesh
  const MeshKind kind = MeshOf(view.mode);
  const std::shared_ptr<const MeshState>& mesh =
      kept_->Mesh(kind) ? kept_->Mesh(kind) : kept_->Mesh(MeshKind::kFlat);
  const Selection none;
  const AnalysisResults nothing;
  picture_.Make({*kept_, *mesh, same.overlays, none, nothing, false}, same, {}, right.width, right.height);
  screen_ = right;
  const int border = std::clamp(static_cast<int>(at * right.width), 0, right.width);
  const Srgb8Image& left = picture_.screen();
  for (int y = 0; y < right.height; ++y) {
    const std::size_t row = 3 * left.Index(0, y);
    std::copy_n(left.pixels.begin() + static_cast<std::ptrdiff_t>(row), 3 * border,
                screen_.pixels.begin() + static_cast<std::ptrdiff_t>(row));
    if (border > 0 && border < right.width) SetPixel(&screen_, screen_.Index(border, y), {255, 255, 255});
  }
  difference_ = Difference(*now.frame(), *picture_.frame());
  return screen_;
}

}  // namespace penumbra::viewer
