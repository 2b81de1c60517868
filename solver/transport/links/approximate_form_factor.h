// solver/transport/links/approximate_form_factor.h
//
// Approximate form factors between areas by methods from the literature, for comparison with
// AreaFormFactor(), which is exact.

#pragma once

#include <span>

#include "solver/base/progress.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// The unoccluded form factor of a point to a disk of area A about `centre`: A cos cos / (pi r^2 + A)
// (Wallace, Elmquist and Haines 1989). DiskFactor() is 0 if point and disk do not face each other.
double DiskFactor(const Vec3& at, const Vec3& at_normal, const Vec3& centre, const Vec3& normal, double area);

// Replaces each sending part by a point at its centroid, and each receiving part by a disk of the same area
// A: A cos cos / (pi r^2 + A) (Wallace, Elmquist and Haines 1989; Hanrahan, Salzman and Aupperle 1991). A
// pair of parts counts as completely visible if the centroids of the parts see each other, and as completely
// hidden otherwise. The stated error is an estimate, not a bound: the difference from the form factor that
// results if each part is cut into 4.
FormFactorEstimate DiskFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const ExecutionContext& context = {});

// The mean of exact point form factors to the visible part of the receiver, over the points of Cubature() on
// 16 pieces of each sending part (thesis 4.2, method 3). The stated error is an estimate, not a bound: the
// difference from the form factor with 4 pieces of each sending part instead of 16.
FormFactorEstimate CubatureFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                      std::span<const AreaPart> to, const ExecutionContext& context = {});

}  // namespace penumbra
