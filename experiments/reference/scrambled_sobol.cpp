#include "experiments/reference/scrambled_sobol.h"

#include <bit>

#include "solver/base/random.h"

namespace penumbra {
namespace {

// Of each dimension but the first: degree and inner coefficients of its primitive polynomial, first numbers.
struct Generator {
  int degree;
  unsigned coefficients;
  std::array<std::uint32_t, 6> first;
};
constexpr std::array<Generator, ScrambledSobol::kDimensions - 1> kGenerators = {{
    {1, 0, {1}},
    {2, 1, {1, 3}},
    {3, 1, {1, 3, 1}},
    {3, 2, {1, 1, 1}},
    {4, 1, {1, 1, 3, 3}},
    {4, 4, {1, 3, 5, 13}},
    {5, 2, {1, 1, 5, 5, 17}},
    {5, 4, {1, 1, 5, 5, 5}},
    {5, 7, {1, 1, 7, 11, 19}},
    {5, 11, {1, 1, 5, 1, 1}},
    {5, 13, {1, 1, 1, 3, 11}},
    {5, 14, {1, 3, 5, 5, 31}},
    {6, 1, {1, 3, 3, 9, 7, 49}},
    {6, 13, {1, 1, 1, 15, 21, 21}},
    {6, 16, {1, 3, 1, 13, 27, 49}},
}};

// The first digit after the point is the highest bit.
std::array<std::uint32_t, 32> Directions(int dimension) {
  std::array<std::uint32_t, 32> v{};
  if (dimension == 0) {
    for (int k = 0; k < 32; ++k) v[static_cast<std::size_t>(k)] = 1U << (31 - k);
    return v;
  }
  const Generator& generator = kGenerators[static_cast<std::size_t>(dimension - 1)];
  const int s = generator.degree;
  for (int k = 0; k < 32; ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (k < s) {
      v[at] = generator.first[at] << (31 - k);
      continue;
    }
    const std::uint32_t before = v[static_cast<std::size_t>(k - s)];
    v[at] = before ^ (before >> s);
    for (int i = 1; i < s; ++i)
      if ((generator.coefficients >> (s - 1 - i)) & 1) v[at] ^= v[static_cast<std::size_t>(k - i)];
  }
  return v;
}

}  // namespace

ScrambledSobol::ScrambledSobol(std::uint64_t seed, std::uint64_t sequence) {
  Random random(seed, sequence);
  for (int d = 0; d < kDimensions; ++d) {
    const std::array<std::uint32_t, 32> plain = Directions(d);
    // Digit i of the result is digit i plus a random choice of those before it.
    std::array<std::uint32_t, 32> row{};
    for (int i = 0; i < 32; ++i) {
      const std::uint32_t digit = 1U << (31 - i);
      const std::uint32_t before = i == 0 ? 0 : ~0U << (32 - i);
      row[static_cast<std::size_t>(i)] = digit | (random.Next() & before);
    }
    for (std::size_t k = 0; k < 32; ++k) {
      std::uint32_t scrambled = 0;
      for (int i = 0; i < 32; ++i)
        if (std::popcount(plain[k] & row[static_cast<std::size_t>(i)]) & 1) scrambled |= 1U << (31 - i);
      direction_[static_cast<std::size_t>(d)][k] = scrambled;
    }
    state_[static_cast<std::size_t>(d)] = random.Next();
  }
}

ScrambledSobol::Point ScrambledSobol::Next() {
  Point point;
  // Gray code: one direction number turns a point into the next.
  const auto k = static_cast<std::size_t>(std::countr_one(index_++)) % 32;
  for (std::size_t d = 0; d < kDimensions; ++d) {
    point[d] = (static_cast<double>(state_[d]) + 0.5) * 0x1p-32;
    state_[d] ^= direction_[d][k];
  }
  return point;
}

}  // namespace penumbra
