#include "display/round_ticks.h"

#include <cmath>

#include "solver/base/check.h"

namespace penumbra {
namespace {

// A multiple that lies outside the range by this fraction of a step is inside: it was computed with rounding.
constexpr double kRoundedSteps = 1e-9;

}  // namespace

std::vector<double> RoundTicks(double low, double high, int most) {
  PENUMBRA_CHECK(low <= high && most >= 2);
  if (low == high) return {low};
  const double power = std::floor(std::log10((high - low) / most));
  for (double decade = power;; ++decade)
    for (const double digit : {1.0, 2.0, 2.5, 5.0}) {
      const double step = digit * std::pow(10, decade);
      const double first = std::ceil(low / step - kRoundedSteps),
                   last = std::floor(high / step + kRoundedSteps);
      if (last - first + 1 > most) continue;
      std::vector<double> ticks;
      for (double k = first; k <= last; ++k) ticks.push_back(k * step + 0.0);  // not -0
      return ticks;
    }
}

}  // namespace penumbra
