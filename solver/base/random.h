// solver/base/random.h
//
// A seeded random number generator that gives the same numbers with every standard library, and a
// low-discrepancy sequence.

#pragma once

#include <cmath>
#include <cstdint>

namespace penumbra {

// The generator PCG32 (O'Neill 2014), which is small, fast, and of good statistical quality. The parameter
// `sequence` selects one of the independent streams of random numbers with the same seed.
class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t sequence = 0) : increment_((sequence << 1) | 1) {
    Next();
    state_ += seed;
    Next();
  }

  std::uint32_t Next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto xorshifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<std::uint32_t>(old >> 59);
    return (xorshifted >> rotation) | (xorshifted << ((32 - rotation) & 31));
  }

  // A random number, uniformly distributed in [0, 1), with 53 random bits.
  double Uniform() {
    const std::uint64_t high = Next() >> 5, low = Next() >> 6;
    return (static_cast<double>(high) * 67108864.0 + static_cast<double>(low)) * 0x1p-53;
  }

  // A random number, uniformly distributed in [a, b).
  double Uniform(double a, double b) { return a + (b - a) * Uniform(); }

  // A random number in [a, b) whose logarithm is uniformly distributed. REQUIRES: a > 0.
  double LogUniform(double a, double b) { return a * std::exp(Uniform() * std::log(b / a)); }

  // A random integer, uniformly distributed in {0, …, n - 1}.
  std::uint32_t Index(std::uint32_t n) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(Next()) * n) >> 32);
  }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

// Element i of an additive recurrence: the fractional part of offset + i * alpha, in [0, 1). The points
// (AdditiveRecurrence(i, kR2Alpha[0]), AdditiveRecurrence(i, kR2Alpha[1])), i = 0, 1, ..., are evenly
// distributed over the unit square. The four constants kR4Alpha give evenly distributed points in the
// four-dimensional unit cube.
inline double AdditiveRecurrence(std::uint64_t i, double alpha, double offset = 0.5) {
  const double x = offset + alpha * static_cast<double>(i);
  return x - std::floor(x);
}
// The constants kR2Alpha and kR4Alpha are the powers 1 to d of 1/x, where x is the positive root of x^(d+1) =
// x + 1, for the dimensions d = 2 and d = 4 (Roberts 2018).
inline constexpr double kR2Alpha[2] = {0.7548776662466927, 0.5698402909980532};
inline constexpr double kR4Alpha[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                       0.5385972572236101};

}  // namespace penumbra
