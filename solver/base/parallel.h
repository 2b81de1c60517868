// solver/base/parallel.h
//
// Parallel loops whose result does not depend on the number of threads: the range is cut into chunks of fixed
// size, each chunk writes only what belongs to its indices, and whoever needs a sum adds the parts in order.

#pragma once

#include <cstddef>
#include <functional>

namespace penumbra {

// The number of threads that parallel loops use from now on; 0 means all that the machine has.
void SetThreadCount(int threads);

// The number of threads that parallel loops use, at least 1.
int ThreadCount();

// Calls body(begin, end) for consecutive chunks of at most `grain` indices that cover [0, count) once each,
// from several threads and in any order. An exception thrown by a body ends the loop and is thrown again
// here. REQUIRES: grain > 0; body is safe to call from several threads at once.
void ParallelForChunks(std::size_t count, std::size_t grain,
                       const std::function<void(std::size_t begin, std::size_t end)>& body);

// Calls body(i) for every i in [0, count); `grain` indices share a task.
template <class Body>
void ParallelFor(std::size_t count, std::size_t grain, const Body& body) {
  ParallelForChunks(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace penumbra
