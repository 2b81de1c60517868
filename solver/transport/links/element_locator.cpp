#include "solver/transport/links/element_locator.h"

#include <algorithm>
#include <cmath>

namespace penumbra {
namespace {

// A patch is a parallelogram if its corners deviate by at most this times its diagonal.
constexpr double kParallelogram = 1e-9;
// Newton's steps for (s, t) on a bilinear patch; four or five suffice.
constexpr int kMostSteps = 20;
constexpr double kSmallStep = 1e-12;

}  // namespace

ElementLocator::ElementLocator(const ElementForest& forest) {
  for (const Patch& patch : forest.scene().patches) {
    Coordinates c;
    c.origin = patch.vertex[0];
    c.is_triangle = patch.size == 3;
    const Vec3 a = patch.vertex[1] - patch.vertex[0];
    const Vec3 b = patch.vertex[static_cast<std::size_t>(patch.size) - 1] - patch.vertex[0];
    const double across = patch.normal.dot(a.cross(b));
    c.s_of = b.cross(patch.normal) / across;
    c.t_of = patch.normal.cross(a) / across;
    c.twist = Vec3::Zero();
    if (!c.is_triangle) {
      c.twist = patch.vertex[0] - patch.vertex[1] + patch.vertex[2] - patch.vertex[3];
      c.is_bilinear = c.twist.norm() > kParallelogram * (patch.vertex[2] - patch.vertex[0]).norm();
    }
    patch_.push_back(c);
  }
  first_child_.reserve(forest.size());
  for (const Element& element : forest.elements()) first_child_.push_back(element.first_child);
}

ElementLocator::Place ElementLocator::Find(PatchId patch, const Vec3& point) const {
  ElementId at = ElementForest::Root(patch);
  const Coordinates& c = patch_[static_cast<std::size_t>(patch)];
  const Vec3 from_origin = point - c.origin;
  double s = c.s_of.dot(from_origin), t = c.t_of.dot(from_origin);
  if (c.is_bilinear) {
    const double ds = c.s_of.dot(c.twist), dt = c.t_of.dot(c.twist), s0 = s, t0 = t;
    for (int step = 0; step < kMostSteps; ++step) {
      // Newton's step for s + ds s t = s0, t + dt s t = t0.
      const double f = s + ds * s * t - s0, g = t + dt * s * t - t0;
      const double fs = 1 + ds * t, ft = ds * s, gs = dt * t, gt = 1 + dt * s;
      const double determinant = fs * gt - ft * gs;
      if (determinant == 0) break;
      const double step_s = (f * gt - g * ft) / determinant, step_t = (g * fs - f * gs) / determinant;
      s = std::clamp(s - step_s, 0.0, 1.0);
      t = std::clamp(t - step_t, 0.0, 1.0);
      if (std::max(std::abs(step_s), std::abs(step_t)) < kSmallStep) break;
    }
  }
  // The order and the orientation of children are those of ElementForest::Subdivide().
  for (ElementId child = first_child_[static_cast<std::size_t>(at)]; child != kNoElement;
       child = first_child_[static_cast<std::size_t>(at)]) {
    if (c.is_triangle) {
      const bool centre = s + t >= 0.5 && s < 0.5 && t < 0.5;
      at = child + (centre ? 3 : s >= 0.5 ? 1 : t >= 0.5 ? 2 : 0);
      const double from_s = s >= 0.5 ? 1 : 0, from_t = t >= 0.5 && s < 0.5 ? 1 : 0;
      s = centre ? 1 - 2 * s : 2 * s - from_s;
      t = centre ? 1 - 2 * t : 2 * t - from_t;
    } else {
      const bool high_s = s >= 0.5, high_t = t >= 0.5;
      at = child + (high_t ? (high_s ? 2 : 3) : (high_s ? 1 : 0));
      s = 2 * s - (high_s ? 1 : 0);
      t = 2 * t - (high_t ? 1 : 0);
    }
  }
  return {at, s, t};
}

}  // namespace penumbra
