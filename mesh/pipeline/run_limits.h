// mesh/pipeline/run_limits.h
//
// Limits on the time and the memory of a run. A run that reaches a limit of time or memory ends as if the
// user had cancelled it.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "solver/base/progress.h"

namespace penumbra {

// Returns the memory that this process uses now [bytes], or 0 if the memory is unknown.
std::uint64_t ResidentBytes();

// RunLimits starts a thread that watches the limits of time and memory until the object is destroyed. If
// neither a time limit nor a memory limit is given, no thread is started, and context() returns the outer
// context.
class RunLimits {
 public:
  using Clock = std::chrono::steady_clock;

  // The time limit ends `seconds` after `begin`. The memory limit is (1 - kept) * bytes for the whole
  // process. The fraction `kept` of the memory limit is reserved for work after the run.
  RunLimits(const ExecutionContext& outer, std::optional<double> seconds, std::optional<double> bytes,
            Clock::time_point begin = Clock::now(), double kept = 0);
  ~RunLimits();
  RunLimits(const RunLimits&) = delete;
  RunLimits& operator=(const RunLimits&) = delete;

  // The execution context for the run, which forwards progress to the outer execution context. The run is
  // cancelled if the outer execution context is cancelled or if a limit is reached.
  const ExecutionContext& context() const { return watched() ? inner_ : outer_; }

  // Returns a description of the limit that was reached, or nullopt if no limit was reached.
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
