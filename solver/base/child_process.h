// solver/base/child_process.h
//
// Runs work in a process of its own, so that a library that crashes on damaged input, or never ends, does not
// take the program along.

#pragma once

#include <functional>
#include <string>

namespace penumbra {

struct ChildResult {
  enum class End { kReturned, kThrew, kDied, kTookTooLong };
  End end = End::kDied;
  std::string bytes;  // what the work returned; or, if it threw a std::exception, what()
};

// Calls `work` in a copy of this process and returns the bytes that the work returned there. What the work
// changes in memory stays in the copy, and what it prints is lost. Kills the copy after `most_seconds`. The
// work must not wait for other threads: the copy has only the thread that calls this function. Throws
// std::runtime_error if the system gives no process.
ChildResult RunInChild(const std::function<std::string()>& work, double most_seconds);

}  // namespace penumbra
