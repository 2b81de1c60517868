// solver/scene/surface_points.h
//
// Computes evenly distributed points on the surfaces of a scene.

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solver/scene/scene.h"

namespace penumbra {

// Maps (s, t) in the unit square to a point of a convex polygon. If (s, t) is uniformly distributed, the
// points are uniformly distributed over the area of the polygon. A triangle may be given with four vertices,
// the last vertex repeated.
Vec3 PointOn(std::span<const Vec3> polygon, double s, double t);

struct SurfacePoint {
  PatchId patch = kNoPatch;
  Vec3 position = Vec3::Zero();
};

// Stratified random points: divides the fronts of all patches into `count` parts of equal area, one patch
// after the other, and chooses one random point in each part. Equal seeds give equal points. REQUIRES: the
// scene has patches.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::size_t count, std::uint64_t seed);
// Chooses stratified random points whose density on a patch is proportional to (weight of the patch) / (area
// of the patch). `weights` has one entry for each patch. REQUIRES: at least one weight is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

// Like SpreadPoints() with weights for all patches, but chooses points only on the patches listed in
// `patches`. The weight of patches[i] is weights[i]. REQUIRES: at least one weight is not 0.
std::vector<SurfacePoint> SpreadPoints(const Scene& scene, std::span<const PatchId> patches,
                                       std::span<const double> weights, std::size_t count,
                                       std::uint64_t seed);

}  // namespace penumbra
