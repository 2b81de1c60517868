#include "solver/transport/form_factors/item_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace penumbra {
namespace {

// A plane whose distance from the eye is below this times the coordinates counts as containing the eye:
// rounding alone moves a point so far.
constexpr double kEdgeOn = 1e-13;

// The sample point of a halved cell is the centroid of its upper half, otherwise the centre of the cell.
constexpr double kHalfSample = 2.0 / 3, kWholeSample = 0.5;

// The part of the polygon with normal . v >= 0, for a plane through the origin.
void ClipAtOrigin(const Vec3& normal, std::vector<Vec3>* polygon, std::vector<Vec3>* spare) {
  spare->clear();
  const std::size_t count = polygon->size();
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &a = (*polygon)[i], &b = (*polygon)[(i + 1) % count];
    const double at_a = normal.dot(a), at_b = normal.dot(b);
    if (at_a >= 0) spare->push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0))
      spare->push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  polygon->swap(*spare);
}

// The interval in which the line at height y crosses a convex outline; empty, first > second, if it misses.
// An edge that two outlines share gives both the same number, so that no cell is filled twice or left out.
std::pair<double, double> CrossingAt(std::span<const Vec2> outline, double y) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 *a = &outline[i], *b = &outline[(i + 1) % outline.size()];
    if (a->y() > b->y()) std::swap(a, b);
    if (!(a->y() <= y && y < b->y())) continue;
    const double x = a->x() + (y - a->y()) / (b->y() - a->y()) * (b->x() - a->x());
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return {low, high};
}

}  // namespace

// The plane of a polygon in the grid's axes: a ray (x, y, 1) meets it at distance / (slope . ray).
struct ItemBuffer::Plane {
  double distance = 0;
  Vec3 slope = Vec3::Zero();
  PatchId patch = kNoPatch;
  std::int32_t target = -1;
};

ItemBuffer::ItemBuffer(const PlaneGrid& grid, const Scene& scene, const Eye& eye,
                       std::span<const DrawnPolygon> polygons)
    : grid_(grid), cells_(grid.delta.size()) {
  for (const DrawnPolygon& polygon : polygons)
    if (polygon.patch != eye.own) Draw(scene, eye, polygon);
}

void ItemBuffer::Draw(const Scene& scene, const Eye& eye, const DrawnPolygon& polygon) {
  const Patch& patch = scene.patches[static_cast<std::size_t>(polygon.patch)];
  const auto axis = [&](const Vec3& in_frame) {
    return Vec3(in_frame.x() * eye.x + in_frame.y() * eye.y + in_frame.z() * eye.z);
  };
  const Vec3 right = axis(grid_.right), up = axis(grid_.up), ahead = axis(grid_.ahead);
  Plane plane;
  plane.distance = patch.normal.dot(patch.vertex[0] - eye.position);
  if (std::abs(plane.distance) <= kEdgeOn * std::max(patch.extent, MaxAbs(eye.position))) return;
  plane.slope = {patch.normal.dot(right), patch.normal.dot(up), patch.normal.dot(ahead)};
  plane.patch = polygon.patch;
  plane.target = plane.distance < 0 ? polygon.target : -1;  // the front looks at the eye

  view_.clear();
  for (const Vec3& v : polygon.vertices) {
    const Vec3 way = v - eye.position;
    view_.emplace_back(right.dot(way), up.dot(way), ahead.dot(way));
  }
  const Vec2 low = grid_.low, high = grid_.low + grid_.cell * Vec2(grid_.columns, grid_.rows);
  const std::array<Vec3, 4> sides = {Vec3(1, 0, -low.x()), Vec3(-1, 0, high.x()), Vec3(0, 1, -low.y()),
                                     Vec3(0, -1, high.y())};
  for (const Vec3& side : sides) ClipAtOrigin(side, &view_, &clipped_);
  outline_.clear();
  double bottom = std::numeric_limits<double>::infinity(), top = -bottom;
  for (const Vec3& v : view_) {
    if (v.z() <= 0) return;  // only the eye itself, where all sides meet
    outline_.push_back((Vec2(v.x(), v.y()) / v.z() - low) / grid_.cell);
    bottom = std::min(bottom, outline_.back().y());
    top = std::max(top, outline_.back().y());
  }
  if (outline_.size() < 3) return;
  const int first = std::max(0, static_cast<int>(std::floor(bottom)));
  const int last = std::min(grid_.rows - 1, static_cast<int>(std::floor(top)));
  for (int row = first; row <= last; ++row) FillRow(plane, outline_, row);
}

void ItemBuffer::FillRow(const Plane& plane, std::span<const Vec2> outline, int row) {
  const auto [low, high] = CrossingAt(outline, row + kWholeSample);
  if (low < high) {
    const int first = std::max(grid_.FirstWhole(row), static_cast<int>(std::ceil(low - kWholeSample)));
    const int end = std::min(grid_.columns, static_cast<int>(std::ceil(high - kWholeSample)));
    for (int column = first; column < end; ++column)
      Put(plane, column, row, {column + kWholeSample, row + kWholeSample});
  }
  if (!grid_.halved) return;
  const int column = grid_.columns - 1 - row;
  const auto [left, right] = CrossingAt(outline, row + kHalfSample);
  if (left <= column + kHalfSample && column + kHalfSample < right)
    Put(plane, column, row, {column + kHalfSample, row + kHalfSample});
}

void ItemBuffer::Put(const Plane& plane, int column, int row, const Vec2& sample) {
  const Vec2 at = grid_.low + grid_.cell * sample;
  const double distance = plane.distance / plane.slope.dot(Vec3(at.x(), at.y(), 1));
  if (!(distance > 0)) return;  // the cell sees the plane edge-on, to rounding
  Cell& cell = cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
                      static_cast<std::size_t>(column)];
  const bool same = cell.patch == plane.patch;
  if (cell.distance == 0 || (same ? cell.target < 0 : distance < cell.distance))
    cell = {distance, plane.patch, plane.target};
}

void ItemBuffer::AddFactors(double weight, std::span<double> factors) const {
  for (std::size_t i = 0; i < cells_.size(); ++i)
    if (cells_[i].target >= 0) factors[static_cast<std::size_t>(cells_[i].target)] += weight * grid_.delta[i];
}

}  // namespace penumbra
