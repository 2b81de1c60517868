// mesh/pipeline/run_limits.h
//
// Limits on time and memory. A run that reaches a limit ends as if it were cancelled.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "solver/base/progress.h"

namespace penumbra {

// The memory that this process uses now [bytes]; 0 if unknown.
std::uint64_t ResidentBytes();

// Starts a thread that watches the limits until the object is destroyed. If neither limit is given, no thread
// is started, and context() returns the outer context.
class RunLimits {
 public:
  using Clock = std::chrono::steady_clock;

  // The time limit is `seconds` after `begin`. The memory limit is (1 - kept) * bytes for the whole process;
  // the rest is reserved for work after the run.
  RunLimits(const ExecutionContext& outer, std::optional<double> seconds, std::optional<double> bytes,
            Clock::time_point begin = Clock::now(), double kept = 0);
  ~RunLimits();
  RunLimits(const RunLimits&) = delete;
  RunLimits& operator=(const RunLimits&) = delete;

  // The context for the run: it forwards progress to the outer context, and is cancelled if the outer context
  // is cancelled or if a limit is reached.
  const ExecutionContext& context() const { return watched() ? inner_ : outer_; }

  // A description of the limit that was reached; nullopt if no limit was reached.
  std::optional<std::string> Exceeded() const;

 private:
  bool watched() const { return seconds_ || bytes_; }
  void Check();

  const ExecutionContext& outer_;
  std::optional<double> seconds_, bytes_;
  double kept_;
  Clock::time_point begin_;
  ExecutionContext inner_;
  std::atomic<bool> late_{false}, large_{false}, done_{false};
  std::thread watcher_;
};

}  // namespace penumbra
