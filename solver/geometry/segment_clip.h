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

// The parameter interval [t0, t1] of the part of a segment a + t (b - a) that lies in all half-spaces passed
// to Keep() so far.
struct SegmentClip {
  double t0 = 0, t1 = 1;

  // Keeps the part where a linear function is >= 0. The function has the value `va` at t = 0 and `vb` at t =
  // 1.
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

// The point a + t (b - a): exactly a at t = 0, exactly b at t = 1.
inline Vec3 Between(const Vec3& a, const Vec3& b, double t) {
  return t == 0 ? a : t == 1 ? b : Vec3((1 - t) * a + t * b);
}

// The part of the segment ab that lies in the convex polygon or within `tolerance` [m] of it; empty if there
// is none. The segment lies in the polygon's plane. The polygon is counter-clockwise about `normal`.
std::optional<std::array<Vec3, 2>> ClipToPolygon(const Vec3& a, const Vec3& b, std::span<const Vec3> polygon,
                                                 const Vec3& normal, double tolerance);

}  // namespace penumbra
