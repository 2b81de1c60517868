// display/round_ticks.h

#pragma once

#include <vector>

namespace penumbra {

// The round numbers from `low` to `high`: multiples of 1, 2, 2.5 or 5 times a power of ten, whichever gives
// the most numbers, but at most `most`. If low = high, this number alone. REQUIRES: low <= high, both are
// finite, most >= 2.
std::vector<double> RoundTicks(double low, double high, int most);

}  // namespace penumbra
