#include "solver/transport/points/neighbour_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>

#include "solver/base/check.h"

namespace penumbra {
namespace {

constexpr int kBitsAnAxis = 16;

// The place of a cell of a cube of 2^kBitsAnAxis cells a side along Morton's curve. `p` lies in the cube of
// side `extent` at the origin.
std::uint64_t PlaceOnCurve(const Vec3& p, double extent) {
  std::uint64_t place = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = extent > 0 ? std::floor(p[axis] / extent * (1 << kBitsAnAxis)) : 0;
    const auto number = static_cast<std::uint64_t>(std::clamp(cell, 0.0, (1 << kBitsAnAxis) - 1.0));
    for (int bit = 0; bit < kBitsAnAxis; ++bit) place |= (number >> bit & 1) << (3 * bit + axis);
  }
  return place;
}

}  // namespace

std::vector<std::vector<std::size_t>> GroupNeighbours(std::span<const ReceiverPoint> points,
                                                      std::size_t most) {
  PENUMBRA_CHECK(most > 0);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const ReceiverPoint& point : points) {
    low = low.cwiseMin(point.position);
    high = high.cwiseMax(point.position);
  }
  struct Key {
    Vec3 normal;
    std::uint64_t place;
    std::size_t point;
  };
  std::vector<Key> keys;
  keys.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    keys.push_back({points[i].normal, PlaceOnCurve(points[i].position - low, (high - low).maxCoeff()), i});
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return std::tie(a.normal.x(), a.normal.y(), a.normal.z(), a.place, a.point) <
           std::tie(b.normal.x(), b.normal.y(), b.normal.z(), b.place, b.point);
  });
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i == 0 || keys[i].normal != keys[i - 1].normal || groups.back().size() == most) groups.emplace_back();
    groups.back().push_back(keys[i].point);
  }
  return groups;
}

}  // namespace penumbra
