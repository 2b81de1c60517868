// solver/base/parallel.h
//
// Parallel loops whose result does not depend on the number of threads. A loop divides the range of its index
// into chunks of fixed size. Each chunk of indices writes only the results of its own indices, and callers
// add up partial sums in the order of the chunks.

#pragma once

#include <cstddef>
#include <functional>

namespace penumbra {

// Sets the number of threads of all later parallel loops; 0 means one thread for each processor of the
// machine.
void SetThreadCount(int threads);

// The number of threads that parallel loops use, at least 1.
int ThreadCount();

// Divides the index range [0, count) into consecutive chunks of at most `grain` indices and calls body(begin,
// end) once for each chunk, from several threads and in any order. If `body` throws, the loop ends, and
// ParallelForChunks() rethrows the exception. REQUIRES: grain > 0; `body` may be called from several threads
// at once.
void ParallelForChunks(std::size_t count, std::size_t grain,
                       const std::function<void(std::size_t begin, std::size_t end)>& body);

// Calls body(i) for every i in [0, count), in chunks of `grain` indices, with several threads; see
// ParallelForChunks().
template <class Body>
void ParallelFor(std::size_t count, std::size_t grain, const Body& body) {
  ParallelForChunks(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

}  // namespace penumbra
