// solver/base/child_process.h
//
// Runs a function in a child process, so that a library that crashes or hangs on damaged input cannot crash
// or hang the program.

#pragma once

#include <functional>
#include <string>

namespace penumbra {

struct ChildResult {
  enum class End { kReturned, kThrew, kDied, kTookTooLong };
  End end = End::kDied;
  // The bytes that the function returned, or the message what() of the exception that it threw.
  std::string bytes;
};

// Calls the function `work` in a child process, a copy of the calling process, and returns the bytes that
// `work` returned. Changes that the function `work` makes to memory have no effect in the calling process,
// and text that `work` prints is not shown. The child process is killed if it still runs after `most_seconds`
// seconds. The function `work` must not wait for other threads, because the child process has only one
// thread. Throws std::runtime_error if the system cannot create a process.
ChildResult RunInChild(const std::function<std::string()>& work, double most_seconds);

}  // namespace penumbra
