#include "solver/visibility/point/enclosure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/geometry/polygon.h"
#include "solver/scene/tolerances.h"

namespace penumbra {

std::vector<Vec3> LookAround(const Vec3& normal) {
  constexpr double kOneDegree = std::numbers::pi / 180;
  const Frame frame = MakeFrame(Vec3::Zero(), normal);
  std::vector<Vec3> directions = {normal};
  for (const double from_normal : {45 * kOneDegree, 75 * kOneDegree})
    for (int i = 0; i < 6; ++i) {
      const double around = (60 * i + 17) * kOneDegree;  // off the axes, along which scenes have their edges
      directions.push_back(std::sin(from_normal) * (std::cos(around) * frame.u + std::sin(around) * frame.v) +
                           std::cos(from_normal) * normal);
    }
  return directions;
}

Enclosure::Enclosure(const Scene& scene) : rays_(scene), lift_(2 * ContactGap(scene)) {}

bool Enclosure::Surrounds(const Vec3& position, const Vec3& normal) const {
  const Vec3 from = position + lift_ * normal;
  const std::vector<Vec3> directions = LookAround(normal);
  return std::all_of(directions.begin(), directions.end(), [&](const Vec3& direction) {
    const RayCaster::Hit hit = rays_.Cast(from, direction);
    return hit.patch != kNoPatch && !hit.front;
  });
}

}  // namespace penumbra
