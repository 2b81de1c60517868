#include "experiments/reference/emitters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/base/scratch.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

// From nearer than this many radii of the emitter points are chosen by solid angle: there the weights of
// points chosen by area vary by more than some hundredths; from farther away solid angles lose digits.
constexpr double kNear = 4;

}  // namespace

double SphericalTriangleArea(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::abs(std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a)));
}

Vec3 OnSphericalTriangle(const Vec3& a, const Vec3& b, const Vec3& c, double area, double v, double w) {
  const Vec3 to_b = (b - a.dot(b) * a).normalized(), to_c = (c - a.dot(c) * a).normalized();
  const double cos_alpha = std::clamp(to_b.dot(to_c), -1.0, 1.0), sin_alpha = to_b.cross(to_c).norm();
  const double phi = v * area - std::atan2(sin_alpha, cos_alpha);
  const double s = std::sin(phi), t = std::cos(phi), x = t - cos_alpha, y = s + sin_alpha * a.dot(b);
  const double below = (y * s + x * t) * sin_alpha;
  // Of the arc from a to c, as far as the share v of the area needs.
  const double q = below != 0 ? std::clamp(((y * t - x * s) * cos_alpha - y) / below, -1.0, 1.0) : 1;
  const Vec3 end = q * a + std::sqrt(1 - q * q) * to_c;
  const double z = 1 - w * (1 - end.dot(b));
  Vec3 across = end - end.dot(b) * b;
  if (across.squaredNorm() > 0) across.normalize();
  return z * b + std::sqrt(std::max(0.0, 1 - z * z)) * across;
}

Emitters::Emitters(const Scene& scene) : scene_(&scene) {
  for (std::size_t p = 0; p < scene.patches.size(); ++p) {
    const Patch& patch = scene.patches[p];
    const Rgb& emittance = scene.materials[static_cast<std::size_t>(patch.material)].emittance;
    if (!(emittance > 0).any()) continue;
    Emitter emitter{
        static_cast<PatchId>(p), Centroid(patch.Vertices()), 0, emittance.mean(), emittance, false};
    for (const Vec3& v : patch.Vertices())
      emitter.radius = std::max(emitter.radius, (v - emitter.centre).norm());
    emitter.parallelogram =
        patch.size == 4 && (patch.vertex[0] + patch.vertex[2] - patch.vertex[1] - patch.vertex[3]).norm() <=
                               1e-15 * patch.extent;
    emitters_.push_back(emitter);
  }
}

// Above 0 wherever the emitter may bring something.
double Emitters::Guess(const Emitter& emitter, const Vec3& at, const Vec3& normal) const {
  const Patch& patch = scene_->patches[static_cast<std::size_t>(emitter.patch)];
  const double before = patch.normal.dot(at - patch.vertex[0]);
  const Vec3 to = emitter.centre - at;
  const double above = normal.dot(to) + emitter.radius;
  if (before <= 0 || above <= 0) return 0;
  const double square = to.squaredNorm(), distance = std::sqrt(square);
  const double cosines =
      std::min(1.0, above / distance) * std::min(1.0, (before + 0.1 * emitter.radius) / distance);
  return emitter.strength * patch.area * cosines / (square + patch.area / std::numbers::pi);
}

EmitterSample Emitters::ByArea(const Emitter& emitter, const Vec3& at, const Vec3& normal, double v,
                               double w) const {
  const Patch& patch = scene_->patches[static_cast<std::size_t>(emitter.patch)];
  const Vec3 point = emitter.parallelogram ? Vec3(patch.vertex[0] + v * (patch.vertex[1] - patch.vertex[0]) +
                                                  w * (patch.vertex[3] - patch.vertex[0]))
                                           : PointOn(patch.Vertices(), v, w);
  const Vec3 to = point - at;
  const double square = to.squaredNorm(), cosines = normal.dot(to) * -patch.normal.dot(to);
  if (normal.dot(to) <= 0 || cosines <= 0) return {};
  return {emitter.patch, point,
          emitter.emittance * (cosines * patch.area / (std::numbers::pi * square * square))};
}

EmitterSample Emitters::BySolidAngle(const Emitter& emitter, const Vec3& at, const Vec3& normal, double v,
                                     double w) const {
  const Patch& patch = scene_->patches[static_cast<std::size_t>(emitter.patch)];
  // What lies above the horizon; a convex polygon gains at most one vertex.
  std::array<Vec3, 5> corner;
  std::size_t count = 0;
  const std::span<const Vec3> vertices = patch.Vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vec3 a = vertices[i] - at, b = vertices[(i + 1) % vertices.size()] - at;
    const double ha = normal.dot(a), hb = normal.dot(b);
    if (ha >= 0) corner[count++] = a.normalized();
    if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0))
      corner[count++] = (std::abs(hb) * a + std::abs(ha) * b).normalized();
  }
  if (count < 3) return {};
  std::array<double, 3> area{};
  double total = 0;
  for (std::size_t k = 0; k + 2 < count; ++k)
    total += area[k] = SphericalTriangleArea(corner[0], corner[k + 1], corner[k + 2]);
  if (total <= 0) return {};
  std::size_t k = 0;
  double share = v * total;
  while (k + 3 < count && share >= area[k]) share -= area[k++];
  if (area[k] <= 0) return {};
  const Vec3 direction = OnSphericalTriangle(corner[0], corner[k + 1], corner[k + 2], area[k],
                                             std::min(1.0, share / area[k]), w);
  const double up = normal.dot(direction), down = patch.normal.dot(direction);
  if (up <= 0 || down >= 0) return {};
  return {emitter.patch, at + patch.normal.dot(patch.vertex[0] - at) / down * direction,
          emitter.emittance * (up * total / std::numbers::pi)};
}

EmitterSample Emitters::Sample(const Vec3& at, const Vec3& normal, double u, double v, double w) const {
  const Emitter* chosen = nullptr;
  double probability = 1;
  if (emitters_.size() == 1) {
    if (Guess(emitters_[0], at, normal) > 0) chosen = &emitters_[0];
  } else {
    const Scratch<std::vector<double>> guesses;
    std::vector<double>& guess = *guesses;
    double total = 0;
    for (const Emitter& emitter : emitters_) total += guess.emplace_back(Guess(emitter, at, normal));
    double left = u * total;
    for (std::size_t i = 0; i < emitters_.size(); ++i) {
      if (guess[i] <= 0) continue;
      chosen = &emitters_[i];
      probability = guess[i] / total;
      if (left < guess[i]) break;
      left -= guess[i];
    }
  }
  if (!chosen) return {};
  EmitterSample sample = (chosen->centre - at).norm() < kNear * chosen->radius
                             ? BySolidAngle(*chosen, at, normal, v, w)
                             : ByArea(*chosen, at, normal, v, w);
  sample.irradiance /= probability;
  return sample;
}

}  // namespace penumbra
