// python/worker_pool.h

#pragma once

#include <functional>

namespace penumbra {

// Runs the job in an idle worker thread, or in a new thread if all worker threads are busy; returns without
// waiting for the job. After a job, its thread is kept for later jobs until the process ends. The library
// oneTBB and the solver's working memory (Scratch) keep memory for each thread that calls them, so that a new
// thread for each job would make the process grow. REQUIRES: the job does not throw.
void RunInWorker(std::function<void()> job);

}  // namespace penumbra
