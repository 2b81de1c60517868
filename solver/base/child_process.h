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

// Calls `work` in a child process, a copy of this process, and returns the bytes that `work` returned. If
// `work` changes memory, this process does not see the change; if `work` prints, nothing is shown. The child
// is killed after `most_seconds`. `work` must not wait for other threads, because the child has only one
// thread. Throws std::runtime_error if the system gives no process.
ChildResult RunInChild(const std::function<std::string()>& work, double most_seconds);

}  // namespace penumbra
