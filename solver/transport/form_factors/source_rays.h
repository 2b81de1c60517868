// solver/transport/form_factors/source_rays.h
//
// Form factors by rays from points of one area to random points of the other (Wallace, Elmquist and Haines
// 1989; Ashdown 1994, 5.23 and 5.24).

#pragma once

#include "solver/transport/form_factors/pair_form_factor.h"

namespace penumbra {

// The number of rays from a point to an area; Ashdown (1994) calls the result of 16 rays "excellent".
inline constexpr std::size_t kSourceRays = 16;

// The two formulas for the form factor of a point to an area A by n rays to random points of the area.
enum class RayFormula {
  // F = (A / n) sum V cos cos / (pi r^2), where V is 1 for visible points and 0 for hidden points.
  kUnbiased,
  // F = (A / n) sum V cos cos / (pi r^2 + A / n), as printed in the literature: each ray stands for a disk of
  // area A / n.
  kDisks,
};

// The form factor of a point of the sender to the target, from `rays` rays to random points of the target.
FormFactorEstimate PointFactorByRays(const SightedPair& pair, const Vec3& at, std::size_t rays,
                                     RayFormula formula, Random* random);

// The mean of PointFactorByRays() over the points of Cubature() on the sender. Each point of the sender casts
// max(1, pair.rays / (number of points)) rays. With more than 1000 rays, the points of the sender are those
// of Cubature() on 4 quarters of the sender. The error of FactorBySourceRays() is (standard error) +
// |difference from the mean over fewer points of the sender|.
FormFactorEstimate FactorBySourceRays(const SightedPair& pair, RayFormula formula);

}  // namespace penumbra
