// solver/base/progress.h
//
// How a long operation tells how far it is and learns that it shall stop. The solver never prints: whoever
// started it listens.

#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace penumbra {

// Passed down every long operation. Report() may be called from one thread at a time, Cancel() from any.
class ExecutionContext {
 public:
  using Listener = std::function<void(std::string_view phase, double fraction)>;

  ExecutionContext() = default;
  explicit ExecutionContext(Listener listener) : listener_(std::move(listener)) {}

  // Tells the listener that `phase` has done `fraction` in [0, 1] of its work.
  void Report(std::string_view phase, double fraction) const {
    if (listener_) listener_(phase, fraction);
  }

  // Asks the operation to end early. It leaves valid results of the last whole step.
  void Cancel() { cancelled_ = true; }
  bool Cancelled() const { return cancelled_; }

 private:
  Listener listener_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace penumbra
