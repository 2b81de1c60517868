// python/background_work.h
//
// Runs a long computation for a caller in Python. During the computation, other Python threads run, progress
// is reported, and Ctrl-C cancels the computation.

#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <mutex>

#include "solver/base/progress.h"

namespace penumbra {

// Calls work(context) in another thread, without Python's global interpreter lock (GIL), and waits until
// `work` has ended. While `work` runs, the calling thread reports progress to `progress`, which is None or a
// function (phase: str, fraction: float), and checks for signals. If a signal handler or `progress` raises an
// exception, for example KeyboardInterrupt, the context is cancelled, and the exception is raised after
// `work` has ended. An exception of `work` is thrown again. `work` must not use Python objects. REQUIRES: the
// caller holds the GIL.
void RunInBackground(const pybind11::object& progress,
                     const std::function<void(const ExecutionContext&)>& work);

// Locks the mutex; other Python threads can run while this function waits for the mutex. REQUIRES: the caller
// holds Python's global interpreter lock (GIL).
std::unique_lock<std::mutex> LockWithoutGil(std::mutex& mutex);

}  // namespace penumbra
