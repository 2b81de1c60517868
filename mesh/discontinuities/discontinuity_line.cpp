#include "mesh/discontinuities/discontinuity_line.h"

#include <algorithm>
#include <limits>

namespace penumbra {

bool Covers(std::span<const LineInterval> intervals, double t, double reach) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [&](const LineInterval& i) { return t >= i.t0 - reach && t <= i.t1 + reach; });
}

LineInterval ClipLine(const Vec2& origin, const Vec2& direction, const Polygon2& outline, double inset) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  LineInterval clip = {-kInfinity, kInfinity};
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2& a = outline[k];
    const Vec2 side = (outline[(k + 1) % outline.size()] - a).normalized();
    const double depth = Cross2(side, origin - a) - inset;  // of the origin inside the half-plane
    const double rate = Cross2(side, direction);
    if (rate == 0) {
      if (depth < 0) return {1, 0};
    } else if (rate > 0) {
      clip.t0 = std::max(clip.t0, -depth / rate);
    } else {
      clip.t1 = std::min(clip.t1, -depth / rate);
    }
  }
  return clip;
}

}  // namespace penumbra
