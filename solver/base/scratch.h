// solver/base/scratch.h
//
// Working memory that outlives its use, so that inner loops need not ask for memory again and again. This is
// the only place of the project that keeps anything a thread.

#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "solver/base/check.h"

namespace penumbra {

namespace internal {

// The objects of one type that a thread has made and that nobody uses at the moment.
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

// A lease of an object of type T, for as long as the lease lives. The object is one that an earlier lease of
// this thread has given back, cleared but with the memory that it had, or a new one. Two leases that live at
// the same time never share an object, however they are nested: not in recursion, and not where a thread that
// waits for a parallel loop begins another piece of work. T has clear() or Clear(), after which it must
// behave like a new object.
//
// A lease belongs to the thread that made it, and ends before that thread does: a local variable, or a member
// of one. PENUMBRA_DCHECK tells where another thread uses it. A lease costs some nanoseconds: take one for an
// evaluation of irradiance, and pass the object on to what works on single polygons.
template <class T>
class Scratch {
 public:
  Scratch() : pool_(ThreadPool()) {
    if (pool_.idle.empty()) {
      pool_.idle.reserve(pool_.leased + 1);  // giving back cannot fail
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
