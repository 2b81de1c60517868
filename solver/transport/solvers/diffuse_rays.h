// solver/transport/solvers/diffuse_rays.h

#pragma once

#include <cstdint>
#include <span>

#include "solver/geometry/vec.h"

namespace penumbra {

struct DiffuseRay {
  Vec3 origin, direction;  // [m]; unit
};

// The i-th of a sequence of rays that leave a convex polygon evenly, cosine distributed about its normal
// (unit), by a low-discrepancy rule. They begin `lift` [m] before it: what lies on it, looking the other way,
// neither is met nor blocks.
DiffuseRay MakeDiffuseRay(std::span<const Vec3> polygon, const Vec3& normal, double lift, std::size_t i,
                          std::uint64_t seed);

}  // namespace penumbra
