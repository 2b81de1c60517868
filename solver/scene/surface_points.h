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

// Stratified random points: divides the fronts of all patches into `count` parts of equal area, one patch
// after the other, and chooses one random point in each part. The same seed gives the same points. REQUIRES:
// the scene has patches.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed);
// Chooses points with a density in proportion to weight / area of the patch, instead of a constant density;
// `weights` has one entry per patch. REQUIRES: at least one weight is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

// Like the function above, but chooses points on the listed patches only. weights[i] is the weight of
// patches[i]. REQUIRES: at least one weight is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const PatchId> patches,
                                       std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

}  // namespace penumbra
