// solver/transport/points/diffuse_rays.h

#pragma once

#include <cstdint>
#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

struct DiffuseRay {
  Vec3 origin, direction;  // origin of the ray [m] and its direction, a unit vector
};

// Ray i of a low-discrepancy sequence of rays that start uniformly distributed over a convex polygon and have
// cosine-distributed directions about the unit vector `normal`. The rays start at a distance `lift` [m] in
// front of the polygon, so that no ray hits a coincident polygon that faces the opposite way.
DiffuseRay MakeDiffuseRay(std::span<const Vec3> polygon, const Vec3& normal, double lift, std::size_t i,
                          std::uint64_t seed);

}  // namespace penumbra
