// mesh/pipeline/option_range.h
//
// The ranges of the numbers that users may give as options.

#pragma once

#include <cstdint>

namespace penumbra {

// Squares and products of numbers between kTiniestOption and kLargestOption neither underflow to zero nor
// overflow.
inline constexpr double kTiniestOption = 1e-100, kLargestOption = 1e100;

// The range of numbers from `low` to `high`, and also the number 0 if `or_zero` is true.
struct NumberRange {
  double low = 0, high = 0;
  bool or_zero = false;
  bool Holds(double x) const { return (x >= low && x <= high) || (or_zero && x == 0); }
};

// The range of integers from `low` to `high`; only powers of two if `powers_of_two` is true.
struct IntegerRange {
  std::uint64_t low = 0, high = 0;
  bool powers_of_two = false;
  bool Holds(std::uint64_t n) const {
    return n >= low && n <= high && (!powers_of_two || (n & (n - 1)) == 0);
  }
};

}  // namespace penumbra
