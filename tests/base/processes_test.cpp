// Loops that are dealt out to processes: every index is computed once, and known everywhere.

#include "solver/base/processes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>

#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// One of several processes that are run one after another: the first time it only keeps what it would send,
// the second time it receives what all have kept.
class TakenInTurn final : public ProcessGroup {
 public:
  TakenInTurn(int rank, int size, std::vector<std::string>* sent) : rank_(rank), size_(size), sent_(sent) {}

  int Rank() const override { return rank_; }
  int Size() const override { return size_; }
  std::vector<std::string> Exchange(const std::string& own) const override {
    (*sent_)[static_cast<std::size_t>(rank_)] = own;
    return *sent_;
  }

 private:
  int rank_, size_;
  std::vector<std::string>* sent_;
};

struct Joined {
  explicit Joined(std::shared_ptr<const ProcessGroup> group) { JoinProcesses(std::move(group)); }
  ~Joined() { JoinProcesses(nullptr); }
};

TEST(Processes, EachIndexIsComputedOnceAndKnownEverywhere) {
  for (const int size : {1, 2, 3, 7})
    for (const std::size_t count : {0U, 1U, 5U, 64U, 1001U}) {
      std::vector<std::string> sent(static_cast<std::size_t>(size));
      std::vector<std::atomic<int>> times(count);
      std::vector<std::string> results;
      for (int turn = 0; turn < 2; ++turn)
        for (int rank = 0; rank < size; ++rank) {
          const Joined joined(std::make_shared<const TakenInTurn>(rank, size, &sent));
          results.assign(count, "");
          const auto compute = [&](std::size_t i) {
            if (turn == 0) ++times[i];
            results[i] = std::to_string(i * i);
          };
          try {
            DealOut(std::span(results), 4, compute);
          } catch (const std::runtime_error&) {
            ASSERT_EQ(turn, 0);  // not all have sent yet
            continue;
          }
          if (turn == 0) continue;
          for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(results[i], std::to_string(i * i));
        }
      for (const std::atomic<int>& of_index : times) EXPECT_EQ(of_index, 1);
    }
  EXPECT_EQ(ProcessCount(), 1);
}

// Inside of another loop, where processes would meet in different orders, each process computes everything.
TEST(Processes, NothingIsDealtInsideOfLoops) {
  std::vector<std::string> sent(2);
  const Joined joined(std::make_shared<const TakenInTurn>(1, 2, &sent));
  std::atomic<int> computed{0};
  ParallelFor(3, 1, [&](std::size_t) {
    std::vector<int> results(10);
    DealOut(std::span(results), 1, [&](std::size_t) { ++computed; });
  });
  EXPECT_EQ(computed, 30);
  EXPECT_TRUE(sent[1].empty());
}

TEST(Processes, TheFirstSpeaksForAll) {
  std::vector<std::string> sent = {"first", ""};
  EXPECT_EQ(FromFirstProcess("alone"), "alone");
  const Joined joined(std::make_shared<const TakenInTurn>(1, 2, &sent));
  EXPECT_EQ(FromFirstProcess("second"), "first");
  EXPECT_EQ(ProcessRank(), 1);
}

}  // namespace
}  // namespace penumbra
