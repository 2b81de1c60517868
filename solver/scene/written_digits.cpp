#include "solver/scene/written_digits.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace penumbra {
namespace {

struct Digits {
  int decimals = 0;     // the last digit's unit is 10^-decimals
  int significant = 0;  // from the first digit that is not 0 to the last one written
};

Digits DigitsOf(std::string_view word) {
  Digits digits;
  const std::size_t mark = std::min(word.find_first_of("eE"), word.size());
  bool after_point = false;
  for (const char c : word.substr(0, mark)) {
    if (c == '.') after_point = true;
    if (c < '0' || c > '9') continue;
    if (after_point) ++digits.decimals;
    if (c != '0' || digits.significant > 0) ++digits.significant;
  }
  int exponent = 0;
  std::string_view power = word.substr(std::min(mark + 1, word.size()));
  if (power.starts_with('+')) power.remove_prefix(1);
  std::from_chars(power.data(), power.data() + power.size(), exponent);
  digits.decimals -= exponent;
  return digits;
}

}  // namespace

void WrittenDigits::Add(int axis, std::string_view word, double value) {
  if (value == 0) return;
  const Digits digits = DigitsOf(word);
  ++with_decimals_[digits.decimals];
  ++with_digits_[digits.significant];
  largest_[axis] = std::max(largest_[axis], std::abs(value));
  // Half a unit, and what the rounding of its power of ten adds.
  constexpr double kHalf = 0.5000001;
  const double off = std::abs(value - static_cast<double>(static_cast<float>(value)));
  single_ = single_ && off <= kHalf * std::pow(10.0, -digits.decimals);
}

Vec3 WrittenDigits::Step() const {
  // Fewer digits are what people write, who mean them exactly.
  constexpr int kFewestSignificant = 6;
  if (with_decimals_.empty()) return Vec3::Zero();
  const auto& [decimals, at_decimals] = *with_decimals_.rbegin();
  const auto& [significant, at_significant] = *with_digits_.rbegin();
  const bool by_digits = significant >= kFewestSignificant && at_significant > at_decimals;
  Vec3 step = Vec3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const double largest = largest_[axis];
    if (largest == 0) continue;
    const int power =
        by_digits ? static_cast<int>(std::floor(std::log10(largest))) + 1 - significant : -decimals;
    step[axis] = std::pow(10.0, power);
    if (single_)
      step[axis] =
          std::max(step[axis], std::exp2(std::ilogb(largest)) * std::numeric_limits<float>::epsilon());
  }
  return step;
}

}  // namespace penumbra
