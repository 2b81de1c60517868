// experiments/reference/scrambled_sobol.h
//
// Random points that fill the unit cube evenly: Sobol's sequence with the direction numbers of Joe and Kuo
// (2008), scrambled by a random linear matrix and a digital shift (Matousek 1998). Each scrambled point is
// uniformly distributed, so that a mean over the points is unbiased. The spread of the means of independent
// scrambles gives the error of the mean.

#pragma once

#include <array>
#include <cstdint>

namespace penumbra {

class ScrambledSobol {
 public:
  static constexpr int kDimensions = 16;
  using Point = std::array<double, kDimensions>;

  // The same seed and sequence number give the same points. Different seeds or sequence numbers give
  // independent points.
  ScrambledSobol(std::uint64_t seed, std::uint64_t sequence);

  // Returns the next point of the sequence, in (0, 1) in each dimension. For k <= 32, consider 2^k successive
  // points whose first index is a multiple of 2^k: each of 2^k equal intervals of every dimension contains
  // exactly one of them.
  Point Next();

 private:
  std::array<std::array<std::uint32_t, 32>, kDimensions> direction_{};
  std::array<std::uint32_t, kDimensions> state_{};
  std::uint32_t index_ = 0;
};

}  // namespace penumbra
