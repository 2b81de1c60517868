#include "display/atlas/chart_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// The rectangle around the patch, with one side along the longest edge.
Chart ChartAround(const Scene& scene, PatchId id) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(id)];
  const std::span<const Vec3> corners = patch.Vertices();
  Vec3 longest = Vec3::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
    if (edge.norm() > longest.norm()) longest = edge;
  }
  Chart chart;
  chart.patch = id;
  chart.u = (longest - longest.dot(patch.normal) * patch.normal).normalized();
  chart.v = chart.u.cross(patch.normal);  // downwards as seen from the front, like the rows of a picture
  Eigen::Array2d low(INFINITY, INFINITY), high = -low;
  for (const Vec3& corner : corners) {
    const Eigen::Array2d at(chart.u.dot(corner - corners[0]), chart.v.dot(corner - corners[0]));
    low = low.min(at);
    high = high.max(at);
  }
  chart.across = high.x() - low.x();
  chart.along = high.y() - low.y();
  chart.corner = corners[0] + low.x() * chart.u + low.y() * chart.v;
  if (chart.across >= chart.along) return chart;
  // A quarter turn lays the longer side across.
  chart.corner += chart.along * chart.v;
  std::swap(chart.across, chart.along);
  const Vec3 u = chart.u;
  chart.u = -chart.v;
  chart.v = u;
  return chart;
}

int Cell(double side, double pixels_per_metre) {
  const double pixels = std::max(1.0, std::ceil(side * pixels_per_metre)) + 2 * kChartPadding;
  constexpr double kMost = 1e9;  // more than any picture has
  return static_cast<int>(std::ceil(std::min(pixels, kMost) / kChartPadding)) * kChartPadding;
}

// Sets the charts side by side in rows, high ones first. Returns the height of all rows, or one larger than
// `size` if they do not fit.
int Place(const std::vector<std::size_t>& order, double pixels_per_metre, int size,
          std::vector<Chart>* charts) {
  int x = 0, y = 0, row = 0;
  for (const std::size_t i : order) {
    Chart& chart = (*charts)[i];
    chart.width = Cell(chart.across, pixels_per_metre);
    chart.height = Cell(chart.along, pixels_per_metre);
    if (chart.width > size) return size + 1;
    if (x + chart.width > size) {
      x = 0;
      y += row;
      row = 0;
    }
    chart.x = x;
    chart.y = y;
    x += chart.width;
    row = std::max(row, chart.height);
    if (y + row > size) return size + 1;
  }
  return y + row;
}

}  // namespace

Eigen::Vector2d ChartLayout::PixelOf(const Chart& chart, const Vec3& point) const {
  const Vec3 from = point - chart.corner;
  return {chart.x + kChartPadding + pixels_per_metre * chart.u.dot(from),
          chart.y + kChartPadding + pixels_per_metre * chart.v.dot(from)};
}

Vec3 ChartLayout::PointAt(const Chart& chart, double x, double y) const {
  return chart.corner + (x - chart.x - kChartPadding) / pixels_per_metre * chart.u +
         (y - chart.y - kChartPadding) / pixels_per_metre * chart.v;
}

ChartLayout LayOutCharts(const Scene& scene, int size) {
  ChartLayout layout;
  layout.size = size;
  double longest = 0;
  for (std::size_t i = 0; i < scene.patches.size(); ++i) {
    layout.charts.push_back(ChartAround(scene, static_cast<PatchId>(i)));
    longest = std::max(longest, layout.charts.back().across);
  }
  if (layout.charts.empty()) return layout;
  std::vector<std::size_t> order(layout.charts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return layout.charts[a].along > layout.charts[b].along;
  });
  // The pixels a metre are known to a part of 2^-kHalvings: charts of whole pixels are coarser than that.
  constexpr int kHalvings = 40;
  double low = 0, high = size / longest;
  const auto fits = [&](double density) { return Place(order, density, size, &layout.charts) <= size; };
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  if (!(low > 0) || !fits(low)) {
    int enough = 2 * std::max(size, 1);
    while (Place(order, 0, enough, &layout.charts) > enough) enough *= 2;
    throw InputError(
        fmt::format("{}: error: an atlas of {} pixels has no room for {} patches; give --atlas {}",
                    scene.name, size, layout.charts.size(), enough));
  }
  layout.pixels_per_metre = low;
  return layout;
}

}  // namespace penumbra
