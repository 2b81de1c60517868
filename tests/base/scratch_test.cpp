// Working memory that is used again: no two users share it, and nothing of an earlier user is left in it.

#include "solver/base/scratch.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "solver/base/lazy_table.h"
#include "solver/base/parallel.h"

namespace penumbra {
namespace {

// An object comes back empty, with the memory that it had.
TEST(Scratch, KeepsMemoryAndNothingElse) {
  const int* memory = nullptr;
  {
    const Scratch<std::vector<int>> first;
    first->assign(1000, 7);
    memory = first->data();
  }
  const Scratch<std::vector<int>> second;
  EXPECT_TRUE(second->empty());
  EXPECT_GE(second->capacity(), 1000U);
  EXPECT_EQ(second->data(), memory);
}

// Leases that live at the same time have objects of their own, in whatever order they end.
TEST(Scratch, NestedLeasesShareNothing) {
  using Lease = Scratch<std::vector<char>>;
  auto a = std::make_unique<Lease>();
  auto b = std::make_unique<Lease>();
  (*a)->push_back('a');
  EXPECT_TRUE((*b)->empty());
  (*b)->push_back('b');
  a.reset();
  EXPECT_EQ((*b)->front(), 'b');
  const Lease c, d;
  EXPECT_TRUE(c->empty() && d->empty());
  EXPECT_EQ((std::set<const void*>{&*c, &*d, &**b}.size()), 3U);
}

// Sums the numbers up to n: each depth of the recursion has a list of its own.
int SumTo(int n) {
  const Scratch<std::vector<int>> list;
  for (int i = 0; i <= n; ++i) list->push_back(i);
  const int below = n > 0 ? SumTo(n - 1) : 0;
  EXPECT_EQ(list->size(), static_cast<std::size_t>(n) + 1);
  return below + list->back();
}

TEST(Scratch, Recurses) { EXPECT_EQ(SumTo(20), 210); }

// A thread that waits for a loop within a loop may begin another turn of the outer one meanwhile.
TEST(Scratch, SurvivesNestedLoops) {
  ParallelFor(200, 1, [](std::size_t i) {
    const Scratch<std::vector<std::size_t>> outer;
    outer->assign(50, i);
    ParallelFor(20, 1, [](std::size_t j) {
      const Scratch<std::vector<std::size_t>> inner;
      EXPECT_TRUE(inner->empty());
      inner->assign(50, j);
    });
    for (const std::size_t value : *outer) EXPECT_EQ(value, i);
  });
}

// A table that has forgotten is like a new one.
TEST(Scratch, TablesForget) {
  for (int round = 0; round < 3; ++round) {
    const Scratch<LazyTable<int>> table;
    table->Begin(10);
    for (int i = 0; i < 10; ++i) {
      const auto [value, is_new] = (*table)[i];
      EXPECT_TRUE(is_new);
      value = i;
    }
    const auto [value, is_new] = (*table)[4];
    EXPECT_FALSE(is_new);
    EXPECT_EQ(value, 4);
  }
}

#ifdef PENUMBRA_CHECKS
// What cannot be right stops the program: an object that another thread uses.
TEST(ScratchDeathTest, StaysInItsThread) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_DEATH(
      {
        const Scratch<std::vector<int>> here;
        std::thread([&] { here->push_back(1); }).join();
      },
      "ThreadPool");
  EXPECT_DEATH(
      {
        auto here = std::make_unique<Scratch<std::vector<int>>>();
        std::thread([&] { here.reset(); }).join();
      },
      "ThreadPool");
}
#endif

}  // namespace
}  // namespace penumbra
