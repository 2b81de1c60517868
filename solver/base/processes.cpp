#include "solver/base/processes.h"

#include <algorithm>
#include <utility>

#include "solver/base/check.h"
#include "solver/base/parallel.h"
#include "solver/base/running_loops.h"

namespace penumbra {
namespace {

std::shared_ptr<const ProcessGroup>& Group() {
  static std::shared_ptr<const ProcessGroup> group;
  return group;
}

// Calls visit(begin, end) for each chunk of the loop that falls to the process of this rank: chunks are dealt
// out in turn, since neighbouring chunks take similar times.
void ForChunksOf(const DealtLoop& loop, std::size_t rank, std::size_t size,
                 const std::function<void(std::size_t begin, std::size_t end)>& visit) {
  for (std::size_t begin = rank * loop.grain; begin < loop.count; begin += size * loop.grain)
    visit(begin, std::min(loop.count, begin + loop.grain));
}

}  // namespace

void JoinProcesses(std::shared_ptr<const ProcessGroup> group) {
  PENUMBRA_CHECK(!LoopIsRunning());
  Group() = std::move(group);
}

int ProcessRank() { return Group() ? Group()->Rank() : 0; }
int ProcessCount() { return Group() ? Group()->Size() : 1; }

std::string FromFirstProcess(std::string own) {
  return Group() ? std::move(Group()->Exchange(own).front()) : std::move(own);
}

void DealOut(const DealtLoop& loop) {
  PENUMBRA_CHECK(loop.grain > 0);
  const auto size = static_cast<std::size_t>(ProcessCount()), rank = static_cast<std::size_t>(ProcessRank());
  if (size == 1 || LoopIsRunning()) return ParallelFor(loop.count, loop.grain, loop.compute);
  const std::size_t chunks = (loop.count + loop.grain - 1) / loop.grain;
  const std::size_t own = (chunks + size - 1 - rank) / size;
  ParallelFor(own, 1, [&](std::size_t k) {
    const std::size_t begin = (k * size + rank) * loop.grain;
    for (std::size_t i = begin; i < std::min(loop.count, begin + loop.grain); ++i) loop.compute(i);
  });
  ByteWriter to;
  ForChunksOf(loop, rank, size, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) loop.write(i, to);
  });
  const std::vector<std::string> sent = Group()->Exchange(to.Take());
  for (std::size_t other = 0; other < size; ++other) {
    if (other == rank) continue;
    ByteReader from(sent[other]);
    ForChunksOf(loop, other, size, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) loop.read(i, from);
    });
  }
}

}  // namespace penumbra
