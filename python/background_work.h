// python/background_work.h
//
// Long work for a caller in Python: other threads of Python run meanwhile, progress is told, and Ctrl-C ends
// it.

#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <mutex>

#include "solver/base/progress.h"

namespace penumbra {

// Calls work(context) in another thread, without Python's lock, and waits for its end. Meanwhile, in the
// calling thread, passes progress on to `progress`, None or a function (phase: str, fraction: float), and
// looks for signals. If a signal or `progress` raises an exception, for example KeyboardInterrupt, cancels
// the context, and raises the exception when the work has ended. Rethrows what the work throws. The work may
// not touch any object of Python. REQUIRES: the caller holds Python's lock.
void RunInBackground(const pybind11::object& progress,
                     const std::function<void(const ExecutionContext&)>& work);

// Locks the mutex. While it waits, other threads of Python run. REQUIRES: the caller holds Python's lock.
std::unique_lock<std::mutex> LockWithoutGil(std::mutex& mutex);

}  // namespace penumbra
