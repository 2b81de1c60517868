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
  std::string bytes;  // the result of the function, or what() of the std::exception that the function threw
};

// Calls `work` in a child process, a copy of this process, and returns the bytes that `work` returned. If
// `work` changes memory, the calling process does not see the change; if `work` prints, nothing is shown. The
// child process is killed if it still runs after `most_seconds` seconds. `work` must not wait for other
// threads, because the child process has only one thread. Throws std::runtime_error if the system cannot
// create a process.
ChildResult RunInChild(const std::function<std::string()>& work, double most_seconds);

}  // namespace penumbra
