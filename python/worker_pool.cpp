#include "python/worker_pool.h"

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace penumbra {
namespace {

// A thread and the job that it is to do next.
struct Worker {
  std::function<void()> job;
  std::condition_variable called;
};

class WorkerPool {
 public:
  void Run(std::function<void()> job) {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {
      auto worker = std::make_shared<Worker>();
      worker->job = std::move(job);
      std::thread([this, worker] { Work(*worker); }).detach();
      workers_.push_back(std::move(worker));
      return;
    }
    Worker& worker = *idle_.back();
    idle_.pop_back();
    worker.job = std::move(job);
    worker.called.notify_one();
  }

 private:
  void Work(Worker& worker) {
    std::unique_lock lock(mutex_);
    while (true) {
      const std::function<void()> job = std::exchange(worker.job, nullptr);
      lock.unlock();
      job();
      lock.lock();
      idle_.push_back(&worker);
      worker.called.wait(lock, [&] { return worker.job != nullptr; });
    }
  }

  std::mutex mutex_;
  std::vector<std::shared_ptr<Worker>> workers_;
  std::vector<Worker*> idle_;
};

}  // namespace

void RunInWorker(std::function<void()> job) {
  // Never destroyed: its threads wait in it when the process ends.
  static WorkerPool& pool = *new WorkerPool;
  pool.Run(std::move(job));
}

}  // namespace penumbra
