#include "mesh/discontinuities/wedge_clip.h"

#include <algorithm>

#include "solver/geometry/segment_clip.h"

namespace penumbra {
namespace {

// The segment in which the patch intersects the plane. Returns false if the patch lies on one side of the
// plane.
bool Section(const Patch& patch, const Vec3& normal, const Vec3& point, double rounding,
             std::array<Vec3, 2>* section) {
  std::array<double, 4> height;
  bool above = false, below = false;
  for (std::int32_t k = 0; k < patch.size; ++k) {
    height[k] = normal.dot(patch.vertex[k] - point);
    if (std::abs(height[k]) <= rounding) height[k] = 0;
    above |= height[k] > 0;
    below |= height[k] < 0;
  }
  if (!above || !below) return false;
  int found = 0;
  for (std::int32_t k = 0; k < patch.size && found < 2; ++k) {
    const std::int32_t next = (k + 1) % patch.size;
    if (height[k] == 0) {
      (*section)[found++] = patch.vertex[k];
    } else if (height[k] * height[next] < 0) {
      (*section)[found++] =
          Between(patch.vertex[k], patch.vertex[next], height[k] / (height[k] - height[next]));
    }
  }
  return found == 2;
}

}  // namespace

void TraceParts::Hide(const Wedge& wedge, const Patch& blocker) {
  if (parts_.empty()) return;
  std::array<Vec3, 2> section;
  if (!Section(blocker, wedge.normal, wedge.apex, wedge.rounding, &section)) return;
  const auto& [a, b] = section;
  const double ha = wedge.receiver_normal.dot(a - wedge.on_receiver);
  const double hb = wedge.receiver_normal.dot(b - wedge.on_receiver);
  const double sa = wedge.source_normal.dot(a - wedge.on_source);
  const double sb = wedge.source_normal.dot(b - wedge.on_source);
  const Vec3 along = wedge.end[1] - wedge.end[0];
  // The parameter, on the trace, of the line through the apex and the point p.
  const auto fraction = [&](const Vec3& p) {
    const double h = wedge.receiver_normal.dot(p - wedge.on_receiver);
    const Vec3 meets = wedge.apex + (p - wedge.apex) * (wedge.apex_height / (wedge.apex_height - h));
    return along.dot(meets - wedge.end[0]) / along.squaredNorm();
  };
  const auto remove = [&](SegmentClip clip) {
    clip.Keep(sa - wedge.rounding, sb - wedge.rounding);
    if (clip.Empty()) return;
    const double t0 = fraction(Between(a, b, clip.t0)), t1 = fraction(Between(a, b, clip.t1));
    Remove(std::min(t0, t1), std::max(t0, t1));
  };
  SegmentClip below;  // between the receiver and the apex
  below.Keep(ha - wedge.rounding, hb - wedge.rounding);
  below.Keep(wedge.apex_height - ha - wedge.rounding, wedge.apex_height - hb - wedge.rounding);
  remove(below);
  if (!wedge.through_apex) return;
  SegmentClip above;  // between the apex and the source's plane
  above.Keep(ha - wedge.apex_height - wedge.rounding, hb - wedge.apex_height - wedge.rounding);
  remove(above);
}

void TraceParts::Remove(double t0, double t1) {
  std::vector<Part> left;
  for (const Part& part : parts_) {
    if (t0 >= part.t1 || t1 <= part.t0) {
      left.push_back(part);
      continue;
    }
    if (part.t0 < t0) left.push_back({part.t0, t0});
    if (t1 < part.t1) left.push_back({t1, part.t1});
  }
  parts_.swap(left);
}

}  // namespace penumbra
