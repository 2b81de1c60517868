// display/atlas/chart_layout.h
//
// A map of all patches of a scene on one square picture (texture atlas). Each patch gets a chart: a rectangle
// of pixels around the patch in the plane of the patch. All charts have the same number of pixels per metre.

#pragma once

#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The number of times that the map can be halved (mipmap levels) before the charts of different patches run
// into one another.
inline constexpr int kAtlasLevels = 2;
// The number of padding pixels of a chart on each side of its patch; charts begin at multiples of
// kChartPadding. A pixel of mipmap level l covers 2^l x 2^l pixels of level 0. Because of the padding, a
// bilinear filter at a point of the patch reads no pixel of another chart, from level 0 to level
// kAtlasLevels.
inline constexpr int kChartPadding = 1 << kAtlasLevels;

struct Chart {
  PatchId patch = kNoPatch;
  Vec3 corner = Vec3::Zero();                 // corner of the rectangle around the patch [m]
  Vec3 u = Vec3::UnitX(), v = Vec3::UnitY();  // unit axes of the rectangle; v x u is the patch's normal
  double across = 0, along = 0;               // sides of the rectangle along u and v [m]; across >= along
  int x = 0, y = 0, width = 0, height = 0;    // place of the chart with its padding [pixels], y from the top
};

struct ChartLayout {
  int size = 0;  // side of the square picture [pixels]
  double pixels_per_metre = 0;
  std::vector<Chart> charts;  // one chart per patch, in the order of the patches

  // The picture coordinates of a point of the patch [pixels]; the centre of pixel (i, j) has the coordinates
  // (i + 1/2, j + 1/2).
  Eigen::Vector2d PixelOf(const Chart& chart, const Vec3& point) const;
  // The inverse of PixelOf(): the point in the plane of the patch at picture coordinates (x, y) [m].
  Vec3 PointAt(const Chart& chart, double x, double y) const;
};

// Places the charts on a picture of size x size pixels, with as many pixels per metre as possible. Throws
// InputError, with a size that is large enough, if `size` leaves no room for the padding of all charts.
ChartLayout LayOutCharts(const Scene& scene, int size);

}  // namespace penumbra
