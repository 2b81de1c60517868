// experiments/reference/reference_points.h
//
// Chooses the points of a scene where reference irradiances are computed by path tracing.

#pragma once

#include <cstdint>
#include <vector>

#include "experiments/reference/path_tracer.h"

namespace penumbra {

// The smallest distance of a reference point to patches on which it does not lie, as a fraction of the
// scene's diagonal. Floats in Embree have errors of about 1e-7 of the scene's diagonal. At the distance
// kClearance, rounding errors in Embree move the outline of a patch by an angle of 5e-4. An outline that
// moves by an angle of 5e-4 changes the irradiance by at most 2e-4 of the light from the hemisphere, and by a
// hundredth of that at usual distances.
inline constexpr double kClearance = 2.5e-4;

// Returns `count` points on the fronts of patches, with the patches' normals. The area of all fronts is
// divided into `count` equal parts, and one reference point is drawn in each part. Points that are covered by
// another patch, or closer than kClearance to one, are drawn again. The same random seed gives the same
// points. Throws InputError if the scene has no room for points at a sufficient distance from other patches.
std::vector<IrradiancePoint> ReferencePoints(const Scene& scene, std::size_t count, std::uint64_t seed);

}  // namespace penumbra
