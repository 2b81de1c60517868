// solver/transport/links/approximate_form_factor.h
//
// Form factors between areas by the ways of others, to compare with AreaFormFactor().

#pragma once

#include <cstdint>
#include <span>

#include "solver/base/progress.h"
#include "solver/visibility/area/area_form_factor.h"

namespace penumbra {

// The form factor of a point to a disk of this area about `centre`, unhindered: A cos cos / (pi r^2 + A)
// (Wallace, Elmquist and Haines 1989); 0 where one does not face the other.
double DiskFactor(const Vec3& at, const Vec3& at_normal, const Vec3& centre, const Vec3& normal, double area);

// Each part that sends is a point at its centroid, each that receives a disk of its area: A cos cos / (pi r^2
// + A) (Wallace, Elmquist and Haines 1989; Hanrahan, Salzman and Aupperle 1991), and all of it or nothing is
// seen, as centroids see each other. The error is the difference from the same with each pair cut into 4 x 4:
// an indication, no bound.
FormFactorEstimate DiskFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                  std::span<const AreaPart> to, const ExecutionContext& context = {});

// The mean of exact visible point factors over the points of Cubature() on each sending part, which is cut
// into 16 first (thesis 4.2, method 3). The error is the difference from the same with 4: an indication, no
// bound.
FormFactorEstimate CubatureFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                      std::span<const AreaPart> to, const ExecutionContext& context = {});

// The share of `rays` random rays, spread evenly over the sending parts with the cosine's density, that meet
// a receiving front first. The error is the standard error, of one hit more among one ray more, so that it is
// never 0.
FormFactorEstimate MonteCarloFormFactor(const Scene& scene, std::span<const AreaPart> from,
                                        std::span<const AreaPart> to, std::size_t rays, std::uint64_t seed,
                                        const ExecutionContext& context = {});

}  // namespace penumbra
