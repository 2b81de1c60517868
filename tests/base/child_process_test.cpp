// Work in a process of its own: what comes back, and how it may end.

#include "solver/base/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace penumbra {
namespace {

// All bytes come back, more than a pipe holds; the parent's memory stays as it was.
TEST(ChildProcess, ReturnsBytesAndChangesNothing) {
  int changed = 0;
  const ChildResult result = RunInChild(
      [&] {
        changed = 1;
        std::string bytes(3'000'000, '\0');
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i % 251);
        return bytes;
      },
      60);
  ASSERT_EQ(result.end, ChildResult::End::kReturned);
  ASSERT_EQ(result.bytes.size(), 3'000'000U);
  for (std::size_t i = 0; i < result.bytes.size(); ++i)
    ASSERT_EQ(result.bytes[i], static_cast<char>(i % 251)) << i;
  EXPECT_EQ(changed, 0);
}

// Exceptions, crashes, exits and endless loops are told apart, and the program lives on.
TEST(ChildProcess, TellsHowTheWorkEnded) {
  const ChildResult threw = RunInChild([]() -> std::string { throw std::runtime_error("too bad"); }, 60);
  EXPECT_EQ(threw.end, ChildResult::End::kThrew);
  EXPECT_EQ(threw.bytes, "too bad");
  const auto killed = []() -> std::string {
    raise(SIGKILL);
    return "";
  };
  EXPECT_EQ(RunInChild(killed, 60).end, ChildResult::End::kDied);
  EXPECT_EQ(RunInChild([]() -> std::string { _exit(0); }, 60).end, ChildResult::End::kDied);
  const auto endless = []() -> std::string {
    while (true) pause();
  };
  EXPECT_EQ(RunInChild(endless, 0.2).end, ChildResult::End::kTookTooLong);
  EXPECT_EQ(RunInChild([] { return std::string(); }, 60).end, ChildResult::End::kReturned);
}

}  // namespace
}  // namespace penumbra
