// solver/visibility/area/pair_counter.h

#pragma once

#include <cstddef>
#include <mutex>

#include "solver/base/progress.h"

namespace penumbra {

// Counts the pairs of areas that several threads have finished, and reports the progress to the context,
// which may be null.
class PairCounter {
 public:
  PairCounter(const ExecutionContext* context, const char* phase, std::size_t pairs)
      : context_(context), phase_(phase), pairs_(pairs) {}

  void Add() {
    if (!context_) return;
    const std::lock_guard lock(mutex_);
    context_->Report(phase_, static_cast<double>(++done_) / static_cast<double>(pairs_));
  }

 private:
  const ExecutionContext* context_;
  const char* phase_;
  std::size_t pairs_, done_ = 0;
  std::mutex mutex_;
};

}  // namespace penumbra
