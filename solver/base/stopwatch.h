// solver/base/stopwatch.h

#pragma once

#include <chrono>

namespace penumbra {

// Measures the wall-clock time in seconds since the Stopwatch was constructed.
class Stopwatch {
 public:
  double Seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace penumbra
