// solver/base/check.h
//
// Two kinds of failure, strictly apart. InputError: what a user gave cannot be used; it ends a command with
// one clear line and exit status 1. PENUMBRA_CHECK: a bug of ours; it aborts with the condition.

#pragma once

#include <stdexcept>
#include <string>

namespace penumbra {

// Something in the user's input is wrong. what() is one line, "FILE:LINE: error: what and how to mend it".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace internal {
[[noreturn]] void CheckFailed(const char* condition, const char* file, int line);
}  // namespace internal

}  // namespace penumbra

// Always on: for contracts whose check costs little.
#define PENUMBRA_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::penumbra::internal::CheckFailed(#condition, __FILE__, __LINE__))

// On in the builds that keep their checks (dev, asan, tsan): for inner loops and whole-structure validation.
#ifdef PENUMBRA_CHECKS
#define PENUMBRA_DCHECK(condition) PENUMBRA_CHECK(condition)
#else
#define PENUMBRA_DCHECK(condition) static_cast<void>(sizeof(condition))
#endif
