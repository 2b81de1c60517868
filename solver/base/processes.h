// solver/base/processes.h
//
// Work that several processes share, on one machine or on many. Every process runs the same program with the
// same arguments and makes the same decisions; the parts of a loop are dealt out to the processes, which then
// exchange their results. What one process computes depends only on the index in the loop, so that the
// results do not depend on the number of processes.

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "solver/base/bytes.h"

namespace penumbra {

// The processes that run one command together.
class ProcessGroup {
 public:
  virtual ~ProcessGroup() = default;

  virtual int Rank() const = 0;  // the number of this process among all processes, from 0
  virtual int Size() const = 0;  // the number of processes that work together, at least 1
  // Sends `own` to all processes. Returns what each process has sent, in the order of their ranks. Every
  // process must call Exchange() the same number of times.
  virtual std::vector<std::string> Exchange(const std::string& own) const = 0;
};

// Makes this process a member of the group; null: the process works alone, as it does until the first call.
// REQUIRES: no loop is running.
void JoinProcesses(std::shared_ptr<const ProcessGroup> group);
// The number of this process, and the number of processes that work together: 0 and 1 if the process works
// alone.
int ProcessRank();
int ProcessCount();

// The bytes that the first process passes, at all processes.
std::string FromFirstProcess(std::string own);

// A loop whose indices can be dealt out. `compute` finds the result of an index, and may be called from
// several threads; `write` appends the result to bytes, and `read` takes the result from bytes.
struct DealtLoop {
  std::size_t count = 0;
  std::size_t grain = 1;  // the number of consecutive loop indices that one task computes
  std::function<void(std::size_t i)> compute;
  std::function<void(std::size_t i, ByteWriter& to)> write;
  std::function<void(std::size_t i, ByteReader& from)> read;
};

// Finds the results of all indices: in parallel, and if several processes work together, each process
// computes a part and receives all other results. Inside of another parallel loop, every process computes
// everything, because processes may not exchange results in different orders.
void DealOut(const DealtLoop& loop);

// DealOut() for a list of results that Transfer() can write and read; compute(i) sets results[i].
template <class Result>
void DealOut(std::span<Result> results, std::size_t grain,
             const std::function<void(std::size_t i)>& compute) {
  DealOut({results.size(), grain, compute,
           [results](std::size_t i, ByteWriter& to) { Transfer(to, results[i]); },
           [results](std::size_t i, ByteReader& from) { Transfer(from, results[i]); }});
}

}  // namespace penumbra
