// solver/geometry/segment_clip.h
//
// Parts of segments.

#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

// The part [t0, t1] of a segment a + t (b - a), cut down by half-spaces.
struct SegmentClip {
  double t0 = 0, t1 = 1;

  // Keeps what has value >= 0, where the value runs linearly from `va` at t = 0 to `vb` at t = 1.
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

// a + t (b - a), with the bits of the ends at 0 and 1.
inline Vec3 Between(const Vec3& a, const Vec3& b, double t) {
  return t == 0 ? a : t == 1 ? b : Vec3((1 - t) * a + t * b);
}

// The part of the segment in the plane of the convex polygon (counter-clockwise about `normal`) that lies in
// it or within `tolerance` [m] of it; empty if there is none.
std::optional<std::array<Vec3, 2>> ClipToPolygon(const Vec3& a, const Vec3& b, std::span<const Vec3> polygon,
                                                 const Vec3& normal, double tolerance);

}  // namespace penumbra
