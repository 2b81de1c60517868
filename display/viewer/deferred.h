// display/viewer/deferred.h
//
// Values that take long to compute, worked out beside the view and shown once they are there.

#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <thread>

#include "solver/base/progress.h"

namespace penumbra::viewer {

// The value of one key at a time; asking for another cancels what is under way. For one thread, that of the
// view. Keys are compared by ==.
template <class Key, class Value>
class Deferred {
 public:
  // Called in a thread of its own. What it gives after a cancel is dropped.
  using Compute = std::function<Value(const Key&, const ExecutionContext&)>;

  explicit Deferred(Compute compute) : compute_(std::move(compute)) {}
  ~Deferred() { Stop(); }
  Deferred(const Deferred&) = delete;
  Deferred& operator=(const Deferred&) = delete;

  // The key's value, or null while it is being computed, which is started if need be.
  std::shared_ptr<const Value> Get(const Key& key) {
    Collect();
    if (key_ && *key_ == key) return value_;
    if (!running_) {
      Start(key);
    } else {
      // Its thread ends soon; the next call after that starts the new one.
      context_->Cancel();
    }
    return nullptr;
  }

  // Forgets the value, and lets what is under way run out.
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

  // There was not enough memory for a value since this was asked last: the key has none.
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
  std::shared_ptr<const Value> result_;  // of the thread, until done_
  std::atomic<bool> done_{false}, no_memory_{false};
  bool running_ = false;
  std::thread thread_;
};

}  // namespace penumbra::viewer
