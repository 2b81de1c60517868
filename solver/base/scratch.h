// solver/base/scratch.h
//
// Reuses working memory from call to call, so that inner loops need not allocate memory each time. No other
// file of the project keeps data per thread.

#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {

namespace internal {

// The objects of type T that a thread has created for reuse and that are not in use at present.
template <class T>
struct ScratchPool {
  std::vector<std::unique_ptr<T>> idle;
  std::size_t leased = 0;

  ScratchPool() = default;
  ScratchPool(const ScratchPool&) = delete;
  ScratchPool& operator=(const ScratchPool&) = delete;
  ~ScratchPool() { PENUMBRA_DCHECK(leased == 0); }
};

template <class T>
void ClearScratch(T& object) {
  if constexpr (requires { object.Clear(); })
    object.Clear();
  else
    object.clear();
}

}  // namespace internal

// A Scratch borrows a buffer, an object of type T, from the present thread for as long as the Scratch lives.
// The borrowed object is either new or was used by an earlier Scratch of the same thread; a used object has
// been cleared, but keeps its allocated memory. Two Scratches that live at the same time never hold the same
// object, even in recursion, or if a thread that waits for a parallel loop runs other work. REQUIRES: T has a
// function clear() or Clear(), after which the object behaves like a new one.
//
// A Scratch must be a local variable or a member of a local variable: a Scratch belongs to the thread that
// created it, and must be destroyed before that thread ends. PENUMBRA_DCHECK detects the use of a Scratch by
// another thread. Because creating a Scratch takes a few nanoseconds, create one Scratch for each evaluation
// of irradiance, and pass the borrowed object to the functions that work on single polygons.
template <class T>
class Scratch {
 public:
  Scratch() : pool_(ThreadPool()) {
    if (pool_.idle.empty()) {
      // Reserves space, so that returning an object to the pool needs no allocation.
      pool_.idle.reserve(pool_.leased + 1);
      object_ = std::make_unique<T>();
    } else {
      object_ = std::move(pool_.idle.back());
      pool_.idle.pop_back();
      internal::ClearScratch(*object_);
    }
    ++pool_.leased;
  }
  ~Scratch() {
    PENUMBRA_DCHECK(&pool_ == &ThreadPool());
    PENUMBRA_DCHECK(pool_.leased > 0);
    --pool_.leased;
    pool_.idle.push_back(std::move(object_));
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  T& operator*() const {
    PENUMBRA_DCHECK(&pool_ == &ThreadPool());
    return *object_;
  }
  T* operator->() const { return &**this; }

 private:
  static internal::ScratchPool<T>& ThreadPool() {
    thread_local internal::ScratchPool<T> pool;
    return pool;
  }

  internal::ScratchPool<T>& pool_;
  std::unique_ptr<T> object_;
};

}  // namespace penumbra
