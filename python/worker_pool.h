// python/worker_pool.h

#pragma once

#include <functional>

namespace penumbra {

// Runs the job in a thread that is kept for later jobs; a new one only if all are busy. Returns at once. Idle
// threads end with the process. Threads are kept because oneTBB and the working memory of the solver
// (Scratch) keep memory for each thread that calls them: a new thread for each job would make the process
// grow. REQUIRES: the job does not throw.
void RunInWorker(std::function<void()> job);

}  // namespace penumbra
