// solver/scene/surface_points.h
//
// Points spread evenly over surfaces.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// The point of a convex triangle or quadrilateral for (s, t) in the unit square; uniform (s, t) give points
// uniform in area. A triangle may be given with its last vertex repeated.
Vec3 PointOn(std::span<const Vec3> polygon, double s, double t);

struct SurfacePoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
};

// One random point in each of `count` equal shares of the fronts' total area, patch after patch. The same
// seed gives the same points. REQUIRES: the scene has patches.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed);
// The same with these weights, one a patch, in the place of areas. REQUIRES: one of them is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

}  // namespace penumbra
