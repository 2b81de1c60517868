// mesh/pipeline/run_limits.h
//
// Limits on time and memory that end a run as if someone had cancelled it.

#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>

#include "solver/base/progress.h"

namespace penumbra {

// The memory that this process has in use now [bytes]; 0 where that cannot be told.
std::uint64_t ResidentBytes();

// Watches a run from a thread of its own, while it lives. Without limits it only passes the context on.
class RunLimits {
 public:
  using Clock = std::chrono::steady_clock;

  // `seconds` from `begin` on; `bytes` that the whole process may take, of which this share is kept for what
  // comes after the run.
  RunLimits(const ExecutionContext& outer, std::optional<double> seconds, std::optional<double> bytes,
            Clock::time_point begin = Clock::now(), double kept = 0);
  ~RunLimits();
  RunLimits(const RunLimits&) = delete;
  RunLimits& operator=(const RunLimits&) = delete;

  // To run with: it reports to the outer one, and is cancelled with it or when a limit is reached.
  const ExecutionContext& context() const { return watched() ? inner_ : outer_; }

  // Which limit was reached, in words; nothing if none was.
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
