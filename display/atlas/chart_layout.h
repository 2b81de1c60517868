// display/atlas/chart_layout.h
//
// A map of all patches on one square picture: each patch becomes a chart, a rectangle of pixels around it in
// its own plane. All charts have the same number of pixels a metre.

#pragma once

#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// How often a map may be halved for a smaller level of detail before charts run into one another.
inline constexpr int kAtlasLevels = 2;
// A chart has so many pixels around its patch on every side, and begins at a multiple of this. A pixel of
// level l covers 2^l pixels a side; between the four pixels that a bilinear filter reads around a point of
// the patch, none then touches another chart, from level 0 to level kAtlasLevels.
inline constexpr int kChartPadding = 1 << kAtlasLevels;

struct Chart {
  PatchId patch = kNoPatch;
  Vec3 corner = Vec3::Zero();                 // of the rectangle around the patch [m]
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();  // its unit axes; v x u is the patch's normal
  double across = 0, along = 0;               // its sides along u and v [m]; across >= along
  int x = 0, y = 0, width = 0, height = 0;    // the chart with its padding [pixels], rows from the top
};

struct ChartLayout {
  int size = 0;  // of the picture, a side [pixels]
  double pixels_per_metre = 0;
  std::vector<Chart> charts;  // one per patch, in their order

  // The place of a point of the patch in the picture [pixels]; the centre of pixel (i, j) is (i + 1/2, j +
  // 1/2).
  Eigen::Vector2d PixelOf(const Chart& chart, const Vec3& point) const;
  // The inverse: the point in the plane of the patch [m].
  Vec3 PointAt(const Chart& chart, double x, double y) const;
};

// Places the charts with as many pixels a metre as `size` allows. Throws InputError, which tells a size that
// is large enough, if there is no room for the padding of all charts.
ChartLayout LayOutCharts(const Scene& scene, int size);

}  // namespace penumbra
