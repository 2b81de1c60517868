#include "solver/transport/points/diffuse_rays.h"

#include <array>
#include <cmath>
#include <numbers>

#include "solver/base/random.h"
#include "solver/scene/surface_points.h"

namespace penumbra {
namespace {

// Distance between the starts of two seeds in the sequence. A prime, so that few seeds share their first rays
// with later rays of other seeds.
constexpr std::uint64_t kSeedStride = 7919;

Vec3 CosineDirection(const Vec3& normal, double s, double t) {
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  const double radius = std::sqrt(s), angle = 2 * std::numbers::pi * t;
  return radius * std::cos(angle) * frame.u + radius * std::sin(angle) * frame.v + std::sqrt(1 - s) * normal;
}

}  // namespace

DiffuseRay MakeDiffuseRay(std::span<const Vec3> polygon, const Vec3& normal, double lift, std::size_t i,
                          std::uint64_t seed) {
  std::array<double, 4> x;
  for (std::size_t d = 0; d < 4; ++d) x[d] = AdditiveRecurrence(i + kSeedStride * seed, kR4Alpha[d]);
  return {PointOn(polygon, x[0], x[1]) + lift * normal, CosineDirection(normal, x[2], x[3])};
}

}  // namespace penumbra
