// display/viewer/deferred.h
//
// Deferred manages a value that takes a long time to compute: a thread computes the value in the background,
// and the view shows the value as soon as the computation is complete.

#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include "solver/base/progress.h"

namespace penumbra::viewer {

// A Deferred holds the value of one key at a time. A request for the value of another key cancels the running
// computation. Only the thread of the view may call the functions of Deferred. Deferred compares keys by ==.
template <class Key, class Value>
class Deferred {
 public:
  // The function that computes the value of a key, in a separate thread. The value from a cancelled
  // computation is discarded.
  using Compute = std::function<Value(const Key&, const ExecutionContext&)>;

  explicit Deferred(Compute compute) : compute_(std::move(compute)) {}
  ~Deferred() { Stop(); }
  Deferred(const Deferred&) = delete;
  Deferred& operator=(const Deferred&) = delete;

  // Returns the value of the key, or null if the computation is not complete. Get() starts the computation if
  // necessary.
  std::shared_ptr<const Value> Get(const Key& key) {
    Collect();
    if (key_ && *key_ == key) return value_;
    if (!running_) {
      Start(key);
    } else {
      // The thread of the old computation ends soon; a later call of Get() starts the new computation.
      context_->Cancel();
    }
    return nullptr;
  }

  // Discards the stored value, and cancels the running computation.
  void Clear() {
    if (running_) context_->Cancel();
    Collect();
    key_.reset();
    value_.reset();
  }

  bool Busy() {
    Collect();
    return running_;
  }

  // True if a computation has run out of memory since the last call of RanOutOfMemory(). The key of a
  // computation that has run out of memory has no value.
  bool RanOutOfMemory() { return no_memory_.exchange(false); }

 private:
  void Start(const Key& key) {
    key_ = key;
    value_.reset();
    context_ = std::make_shared<ExecutionContext>();
    done_ = false;
    running_ = true;
    thread_ = std::thread([this, key, context = context_] {
      try {
        result_ = std::make_shared<const Value>(compute_(key, *context));
      } catch (const std::bad_alloc&) {
        no_memory_ = true;
      }
      done_ = true;
    });
  }

  void Collect() {
    if (!running_ || !done_) return;
    thread_.join();
    running_ = false;
    if (context_->Cancelled()) {
      key_.reset();
      value_.reset();
    } else {
      value_ = std::move(result_);
    }
    result_.reset();
  }

  void Stop() {
    if (!running_) return;
    context_->Cancel();
    thread_.join();
    running_ = false;
  }

  Compute compute_;
  std::optional<Key> key_;
  std::shared_ptr<const Value> value_;
  std::shared_ptr<ExecutionContext> context_;
  // The result of the computation, which only the computing thread may access until done_ is true.
  std::shared_ptr<const Value> result_;
  std::atomic<bool> done_{false}, no_memory_{false};
  bool running_ = false;
  std::thread thread_;
};

}  // namespace penumbra::viewer
