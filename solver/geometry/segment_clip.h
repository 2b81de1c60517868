// solver/geometry/segment_clip.h
//
// Clipping of segments in space.

#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// The part of the segment a + t (b - a) that lies in all half-spaces passed to Keep() so far, as an interval
// [t0, t1] of the parameter t.
struct SegmentClip {
  double t0 = 0, t1 = 1;

  // Keeps the part of the segment where a linear function of t is >= 0. The linear function has the value
  // `va` at t = 0 and `vb` at t = 1.
  void Keep(double va, double vb) {
    if (va >= 0 && vb >= 0) return;
    if (va < 0 && vb < 0) {
      t1 = -1;
      return;
    }
    const double t = va / (va - vb);
    if (va < 0) {
      t0 = std::max(t0, t);
    } else {
      t1 = std::min(t1, t);
    }
  }
  bool Empty() const { return !(t0 < t1); }
};

// The point a + t (b - a) of a segment, which is exactly a at t = 0 and exactly b at t = 1.
inline Vec3 Between(const Vec3& a, const Vec3& b, double t) {
  return t == 0 ? a : t == 1 ? b : Vec3((1 - t) * a + t * b);
}

// The end points of the part of the segment ab that lies in the convex polygon or at most `tolerance` [m]
// outside; nullopt if there is no such part. REQUIRES: the segment lies in the polygon's plane, and the
// polygon is counter-clockwise about `normal`.
std::optional<std::array<Vec3, 2>> ClipToPolygon(const Vec3& a, const Vec3& b, std::span<const Vec3> polygon,
                                                 const Vec3& normal, double tolerance);

}  // namespace penumbra
