#include "solver/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "solver/base/check.h"
#include "solver/base/running_loops.h"

#ifndef PENUMBRA_STD_THREADS
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace penumbra {
namespace {

int HardwareThreads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

std::atomic<int> thread_count{0};
std::atomic<int> loops_running{0};

class CountedLoop {
 public:
  CountedLoop() { ++loops_running; }
  ~CountedLoop() { --loops_running; }
  CountedLoop(const CountedLoop&) = delete;
  CountedLoop& operator=(const CountedLoop&) = delete;
};

#ifdef PENUMBRA_STD_THREADS
// Plain threads that take chunk after chunk: nothing here that the thread sanitizer cannot see into.
void RunChunks(std::size_t chunks, int threads, const std::function<void(std::size_t)>& run) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    for (std::size_t chunk; (chunk = next.fetch_add(1)) < chunks;) {
      try {
        run(chunk);
      } catch (...) {
        const std::lock_guard lock(error_mutex);
        if (!error) error = std::current_exception();
        next = chunks;
      }
    }
  };
  std::vector<std::thread> pool;
  for (int i = 1; i < threads; ++i) pool.emplace_back(work);
  work();
  for (std::thread& thread : pool) thread.join();
  if (error) std::rethrow_exception(error);
}
#else
// Arenas of oneTBB that no loop uses at present, by their number of threads. Each loop has an arena to itself
// while it runs. Arenas are kept, because making and ending one takes longer than a short loop, and because
// oneTBB 2021.8 gives some kilobytes for each arena back only when a worker happens to come by: in a process
// that solves again and again memory grew.
class IdleArenas {
 public:
  std::unique_ptr<tbb::task_arena> Take(int threads) {
    const std::lock_guard lock(mutex_);
    std::vector<std::unique_ptr<tbb::task_arena> >& idle = idle_[threads];
    if (idle.empty()) return std::make_unique<tbb::task_arena>(threads);
    std::unique_ptr<tbb::task_arena> arena = std::move(idle.back());
    idle.pop_back();
    return arena;
  }
  void GiveBack(int threads, std::unique_ptr<tbb::task_arena> arena) {
    const std::lock_guard lock(mutex_);
    idle_[threads].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<std::unique_ptr<tbb::task_arena> > > idle_;
};

// An arena for the time of a loop.
class LeasedArena {
 public:
  explicit LeasedArena(int threads) : threads_(threads), arena_(Idle().Take(threads)) {}
  ~LeasedArena() { Idle().GiveBack(threads_, std::move(arena_)); }
  LeasedArena(const LeasedArena&) = delete;
  LeasedArena& operator=(const LeasedArena&) = delete;

  tbb::task_arena* operator->() const { return arena_.get(); }

 private:
  // Never destroyed: threads may still run loops when the process ends.
  static IdleArenas& Idle() {
    static IdleArenas& idle = *new IdleArenas;
    return idle;
  }

  int threads_;
  std::unique_ptr<tbb::task_arena> arena_;
};

void RunChunks(std::size_t chunks, int threads, const std::function<void(std::size_t)>& run) {
  // More threads than processors bring nothing, and oneTBB complains of them.
  const LeasedArena arena(std::min(threads, HardwareThreads()));
  try {
    arena->execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, chunks, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) run(chunk);
          },
          tbb::simple_partitioner());
    });
  } catch (const std::runtime_error& error) {
    // oneTBB's words where there is no memory for the stack of a thread.
    if (std::string_view(error.what()).starts_with("pthread_create")) throw std::bad_alloc();
    throw;
  }
}
#endif

}  // namespace

void SetThreadCount(int threads) { thread_count = std::max(0, threads); }

int ThreadCount() {
  const int threads = thread_count;
  return threads > 0 ? threads : HardwareThreads();
}

bool LoopIsRunning() { return loops_running > 0; }

void ParallelForChunks(std::size_t count, std::size_t grain,
                       const std::function<void(std::size_t begin, std::size_t end)>& body) {
  PENUMBRA_CHECK(grain > 0);
  const CountedLoop counted;
  const std::size_t chunks = (count + grain - 1) / grain;
  const auto run = [&](std::size_t chunk) { body(chunk * grain, std::min(count, (chunk + 1) * grain)); };
  const int threads =
      static_cast<int>(std::min<std::size_t>(chunks, static_cast<std::size_t>(ThreadCount())));
  if (threads <= 1) {
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) run(chunk);
  } else {
    RunChunks(chunks, threads, run);
  }
}

}  // namespace penumbra
