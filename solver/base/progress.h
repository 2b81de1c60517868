// solver/base/progress.h
//
// Progress reports and cancellation of long operations. The solver never prints; the caller of an operation
// passes a listener, which receives the progress.

#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace penumbra {

// Every long operation has a parameter of type ExecutionContext. Only one thread at a time may call Report();
// any thread may call Cancel().
class ExecutionContext {
 public:
  using Listener = std::function<void(std::string_view phase, double fraction)>;

  ExecutionContext() = default;
  explicit ExecutionContext(Listener listener) : listener_(std::move(listener)) {}

  // Tells the listener that the fraction `fraction`, in [0, 1], of the phase `phase` of the operation is
  // done.
  void Report(std::string_view phase, double fraction) const {
    if (listener_) listener_(phase, fraction);
  }

  // Requests that the operation end early. A cancelled operation leaves the valid results of its last
  // complete step.
  void Cancel() { cancelled_ = true; }
  bool Cancelled() const { return cancelled_; }

 private:
  Listener listener_;
  std::atomic<bool> cancelled_{false};
};

}  // namespace penumbra
