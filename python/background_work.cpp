#include "python/background_work.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "python/worker_pool.h"

namespace penumbra {
namespace {

namespace py = pybind11;

// How long a key press or a progress report waits at most: too short to be noticed, and long enough that the
// looks take no time.
constexpr std::chrono::milliseconds kBetweenLooks{20};

struct ProgressEvent {
  std::string phase;
  double fraction = 0;
};

// What the worker tells the thread that waits for it.
class WorkerNews {
 public:
  void Tell(std::string_view phase, double fraction) {
    const std::lock_guard lock(mutex_);
    // Of each phase, the last report since the last look is enough.
    if (events_.empty() || events_.back().phase != phase) events_.push_back({std::string(phase), 0});
    events_.back().fraction = fraction;
  }

  void End(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    error_ = std::move(error);
    ended_ = true;
    change_.notify_all();
  }

  // Waits for the end, for kBetweenLooks at most. True if the work has ended.
  bool Wait(std::vector<ProgressEvent>* events) {
    std::unique_lock lock(mutex_);
    change_.wait_for(lock, kBetweenLooks, [&] { return ended_; });
    *events = std::exchange(events_, {});
    return ended_;
  }

  void RethrowError() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::condition_variable change_;
  std::vector<ProgressEvent> events_;
  bool ended_ = false;
  std::exception_ptr error_;
};

// Throws what a signal or the function raises.
void PassOn(const py::object& progress, const std::vector<ProgressEvent>& events) {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (progress.is_none()) return;
  for (const ProgressEvent& event : events) progress(event.phase, event.fraction);
}

}  // namespace

void RunInBackground(const py::object& progress, const std::function<void(const ExecutionContext&)>& work) {
  if (!progress.is_none() && !PyCallable_Check(progress.ptr()))
    throw py::type_error("progress is no function; give one that takes (phase, fraction), or None");
  WorkerNews news;
  ExecutionContext context([&](std::string_view phase, double fraction) { news.Tell(phase, fraction); });
  RunInWorker([&] {
    std::exception_ptr error;
    try {
      work(context);
    } catch (...) {
      error = std::current_exception();
    }
    news.End(std::move(error));
  });
  std::exception_ptr stop;
  for (bool ended = false; !ended;) {
    std::vector<ProgressEvent> events;
    {
      const py::gil_scoped_release others_run;
      ended = news.Wait(&events);
    }
    if (stop) continue;
    try {
      PassOn(progress, events);
    } catch (...) {
      stop = std::current_exception();
      context.Cancel();
    }
  }
  if (stop) std::rethrow_exception(stop);
  news.RethrowError();
}

std::unique_lock<std::mutex> LockWithoutGil(std::mutex& mutex) {
  std::unique_lock lock(mutex, std::try_to_lock);
  if (!lock.owns_lock()) {
    const py::gil_scoped_release others_run;
    lock.lock();
  }
  return lock;
}

}  // namespace penumbra
