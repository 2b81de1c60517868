// display/round_ticks.h

#pragma once

#include <vector>

namespace penumbra {

// The round numbers from `low` to `high`, for the ticks of a scale: multiples of 1, 2, 2.5 or 5 times a power
// of ten. RoundTicks() chooses the step (1, 2, 2.5 or 5 times a power of ten) that gives the most numbers,
// but at most `most`. If low = high, RoundTicks() returns only the number `low`. REQUIRES: low <= high, both
// are finite, most >= 2.
std::vector<double> RoundTicks(double low, double high, int most);

}  // namespace penumbra
