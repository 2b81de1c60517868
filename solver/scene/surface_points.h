// solver/scene/surface_points.h
//
// Evenly distributed points on surfaces.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Maps (s, t) in the unit square to a point of a convex triangle or quadrilateral. Uniformly distributed (s,
// t) give points that are uniformly distributed over the area. A triangle may have four vertices, the last
// one repeated.
Vec3 PointOn(std::span<const Vec3> polygon, double s, double t);

struct SurfacePoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
};

// One random point in each of `count` parts of equal area of all fronts, one patch after the other. The same
// seed gives the same points. REQUIRES: the scene has patches.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed);
// Distributes the points by `weights`, one weight per patch, instead of by areas. REQUIRES: at least one
// weight is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

}  // namespace penumbra
