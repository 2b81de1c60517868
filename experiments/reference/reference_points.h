// experiments/reference/reference_points.h
//
// Where references are computed.

#pragma once

#include <cstdint>
#include <vector>

#include "experiments/reference/path_tracer.h"

namespace penumbra {

// Points come no nearer than this part of the scene's diagonal to a patch that they do not lie in. Embree's
// floats are off by some 1e-7 of it: at this distance an outline moves by 5e-4 of a radian, and with it
// 2e-4 of the hemisphere's light at the very most, a hundred times less at the usual distance.
inline constexpr double kClearance = 2.5e-4;

// `count` points on fronts, one in each equal share of their area, with the patches' normals; those too near
// to another patch, or covered by one, are drawn anew. The same seed gives the same points. Throws InputError
// if the scene leaves no room for them.
std::vector<IrradiancePoint> ReferencePoints(const Scene& scene, std::size_t count, std::uint64_t seed);

}  // namespace penumbra
