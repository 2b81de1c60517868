// experiments/reference/scrambled_sobol.h
//
// Points that fill the unit cube evenly and are random all the same: Sobol's sequence with the direction
// numbers of Joe and Kuo (2008), scrambled by a random linear matrix and a digital shift (Matousek 1998).
// Each point is uniformly distributed, so that a mean over them is unbiased; independent scrambles tell its
// error.

#pragma once

#include <array>
#include <cstdint>

namespace penumbra {

class ScrambledSobol {
 public:
  static constexpr int kDimensions = 16;
  using Point = std::array<double, kDimensions>;

  // The same seed and sequence give the same points; two that differ are independent.
  ScrambledSobol(std::uint64_t seed, std::uint64_t sequence);

  // The next point, in (0, 1) in each dimension. Any 2^k points from a multiple of 2^k on, k <= 32, have one
  // point in each of 2^k equal intervals of every dimension.
  Point Next();

 private:
  std::array<std::array<std::uint32_t, 32>, kDimensions> direction_{};
  std::array<std::uint32_t, kDimensions> state_{};
  std::uint32_t index_ = 0;
};

}  // namespace penumbra
